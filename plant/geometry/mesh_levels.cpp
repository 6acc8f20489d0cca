#include "plant/mesh_levels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace bpms {
namespace {

double squared_distance_to_stretch(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0;
  return (p - a - t * along).squaredNorm();
}

double squared_distance_to_triangle(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& t) {
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double square = normal.squaredNorm();
  bool above = square > 0;  // the triangle itself, and not only its sides
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d &a = t[k], &b = t[(k + 1) % 3];
    above = above && normal.cross(b - a).dot(p - a) >= 0;
    nearest = std::min(nearest, squared_distance_to_stretch(p, a, b));
  }
  if (!above) return nearest;
  const double height = (p - t[0]).dot(normal);
  return height * height / square;
}

std::vector<std::vector<std::size_t>> triangles_by_organ(const Mesh& mesh) {
  std::vector<std::vector<std::size_t>> out(mesh.organs.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) out[mesh.organ_of_triangle[t]].push_back(t);
  return out;
}

}  // namespace

double vertex_deviation_m(const Mesh& of, const Mesh& from) {
  const auto own = triangles_by_organ(of), theirs = triangles_by_organ(from);
  double worst = 0;
  for (std::size_t organ = 0; organ < own.size() && organ < theirs.size(); ++organ) {
    if (theirs[organ].empty()) continue;
    std::vector<std::uint32_t> vertices;
    for (const std::size_t t : own[organ])
      vertices.insert(vertices.end(), of.triangles[t].begin(), of.triangles[t].end());
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<std::array<Eigen::Vector3d, 3>> faces;
    for (const std::size_t t : theirs[organ]) {
      const auto& c = from.triangles[t];
      faces.push_back({from.positions_m[c[0]].cast<double>(), from.positions_m[c[1]].cast<double>(),
                       from.positions_m[c[2]].cast<double>()});
    }
    for (const std::uint32_t vertex : vertices) {
      const Eigen::Vector3d p = of.positions_m[vertex].cast<double>();
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& face : faces) nearest = std::min(nearest, squared_distance_to_triangle(p, face));
      worst = std::max(worst, nearest);
    }
  }
  return std::sqrt(worst);
}

std::vector<MeshLevel> mesh_levels(const Plant& plant, const MeshOptions& options, int levels,
                                   double factor) {
  std::vector<MeshLevel> out;
  MeshOptions level = options;
  for (int k = 0; k < levels; ++k, level.tolerance_m *= factor) {
    out.push_back({level.tolerance_m, plant_mesh(plant, level), 0});
    if (k > 0) out.back().deviation_m = vertex_deviation_m(out.front().mesh, out.back().mesh);
  }
  return out;
}

}  // namespace bpms
