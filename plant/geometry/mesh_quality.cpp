#include "plant/mesh_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "core/units.h"
#include "plant/geometry/triangle_crossing.h"

namespace bpms {
namespace {

using Face = std::array<std::uint32_t, 3>;

// Triangles with vertices at one place made one.
std::vector<Face> welded_faces(const Mesh& mesh) {
  std::map<std::array<float, 3>, std::uint32_t> known;
  std::vector<std::uint32_t> number;
  for (const Eigen::Vector3f& p : mesh.positions_m)
    number.push_back(
        known.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(known.size())).first->second);
  std::vector<Face> out;
  for (const Face& t : mesh.triangles) out.push_back({number[t[0]], number[t[1]], number[t[2]]});
  return out;
}

TriangleCorners corners_of(const Mesh& mesh, std::size_t t) {
  const Face& f = mesh.triangles[t];
  return {mesh.positions_m[f[0]].cast<double>(), mesh.positions_m[f[1]].cast<double>(),
          mesh.positions_m[f[2]].cast<double>()};
}

std::uint32_t organ_index(const Mesh& mesh, std::size_t t) {
  return mesh.organ_of_triangle.empty() ? 0 : mesh.organ_of_triangle[t];
}

void judge_shape(const TriangleCorners& p, const MeshQualityOptions& options, MeshQuality& out) {
  double longest = 0, smallest = pi;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
    longest = std::max(longest, a.norm());
    smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  const double height = (p[1] - p[0]).cross(p[2] - p[0]).norm() / longest;
  constexpr double flat = 1e-9;
  if (!(height > flat * longest)) {
    ++out.degenerate;
    return;
  }
  out.smallest_angle_deg = std::min(out.smallest_angle_deg, degrees(smallest));
  out.largest_aspect = std::max(out.largest_aspect, longest / height * std::sqrt(3.0) / 2);
  if (degrees(smallest) < options.sliver_deg) ++out.slivers;
}

void count_edges(const Mesh& mesh, const std::vector<Face>& faces, MeshQuality& out) {
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, int> edges;  // of one organ
  std::set<Face> seen;
  for (std::size_t t = 0; t < faces.size(); ++t) {
    Face sorted = faces[t];
    std::ranges::sort(sorted);
    if (!seen.insert(sorted).second) ++out.duplicate_faces;
    const std::uint32_t organ = organ_index(mesh, t);
    for (const auto& [a, b] :
         {std::pair(sorted[0], sorted[1]), {sorted[1], sorted[2]}, {sorted[0], sorted[2]}})
      ++edges[{organ, a, b}];
  }
  for (const auto& edge : edges) out.non_manifold_edges += edge.second > 2 ? 1 : 0;
}

// Boxes of triangles in the cells of a grid of about their own size.
class TriangleGrid {
 public:
  explicit TriangleGrid(const Mesh& mesh) {
    double extent = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const TriangleCorners p = corners_of(mesh, t);
      boxes_.emplace_back(p[0]);
      boxes_.back().extend(p[1]).extend(p[2]);
      extent += boxes_.back().sizes().maxCoeff();
    }
    cell_ = std::max(extent / static_cast<double>(std::max<std::size_t>(boxes_.size(), 1)), 1e-9);
    for (std::size_t t = 0; t < boxes_.size(); ++t)
      for_cells(boxes_[t], [&](std::uint64_t key) { cells_[key].push_back(static_cast<std::uint32_t>(t)); });
  }

  // Every pair a < b of triangles whose boxes meet, once.
  template <class Visit>
  void for_pairs(const Visit& visit) const {
    std::vector<std::uint32_t> near;
    for (std::uint32_t a = 0; a < boxes_.size(); ++a) {
      near.clear();
      for_cells(boxes_[a], [&](std::uint64_t key) {
        for (const std::uint32_t b : cells_.at(key))
          if (b > a && boxes_[a].intersects(boxes_[b])) near.push_back(b);
      });
      std::ranges::sort(near);
      near.erase(std::unique(near.begin(), near.end()), near.end());
      for (const std::uint32_t b : near) visit(a, b);
    }
  }

 private:
  template <class Visit>
  void for_cells(const Eigen::AlignedBox3d& box, const Visit& visit) const {
    const auto at = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell_)); };
    for (std::int64_t x = at(box.min().x()); x <= at(box.max().x()); ++x)
      for (std::int64_t y = at(box.min().y()); y <= at(box.max().y()); ++y)
        for (std::int64_t z = at(box.min().z()); z <= at(box.max().z()); ++z)
          visit(static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u ^
                static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4Fu ^
                static_cast<std::uint64_t>(z) * 0x165667B19E3779F9u);
  }

  double cell_ = 1;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

bool share_a_corner(const Face& a, const Face& b) {
  return std::ranges::any_of(a, [&](std::uint32_t v) { return std::ranges::find(b, v) != b.end(); });
}

std::vector<MeshCrossing> find_crossings(const Mesh& mesh, const std::vector<Face>& faces,
                                         bool between_organs) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, MeshCrossing> found;
  TriangleGrid(mesh).for_pairs([&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t organ = organ_index(mesh, a), other = organ_index(mesh, b);
    if (organ == other ? share_a_corner(faces[a], faces[b]) : !between_organs) return;
    const TriangleCorners corners = corners_of(mesh, a);
    if (!triangles_cross(corners, corners_of(mesh, b))) return;
    MeshCrossing& crossing = found[{organ, other}];
    if (crossing.pairs++ > 0) return;
    crossing.organ = organ, crossing.other = other;
    crossing.at_m = (corners[0] + corners[1] + corners[2]) / 3;
    for (const std::uint32_t v : mesh.triangles[a])
      if (!mesh.uv.empty()) crossing.l += static_cast<double>(mesh.uv[v].x()) / 3;
  });
  std::vector<MeshCrossing> out;
  for (const auto& entry : found) out.push_back(entry.second);
  return out;
}

}  // namespace

MeshQuality mesh_quality(const Mesh& mesh, const MeshQualityOptions& options) {
  MeshQuality out;
  out.triangles = mesh.triangles.size();
  const std::vector<Face> faces = welded_faces(mesh);
  for (std::size_t t = 0; t < faces.size(); ++t) judge_shape(corners_of(mesh, t), options, out);
  count_edges(mesh, faces, out);
  out.crossings = find_crossings(mesh, faces, options.between_organs);
  return out;
}

}  // namespace bpms
