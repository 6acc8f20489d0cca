#include "plant/exchange/axis_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "plant/geometry/subdivide.h"

namespace bpms {
namespace {

std::uint32_t add_axis_vertex(const Eigen::Vector3d& position, const Eigen::Vector3d& normal, double u,
                              double v, Mesh& mesh) {
  mesh.positions_m.push_back(position.cast<float>());
  mesh.normals.push_back(normal.cast<float>());
  mesh.uv.emplace_back(static_cast<float>(u), static_cast<float>(v));
  return static_cast<std::uint32_t>(mesh.positions_m.size() - 1);
}

void add_axis_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t organ, Mesh& mesh) {
  mesh.triangles.push_back({a, b, c});
  const double area = triangle_area_m2(mesh, mesh.triangles.size() - 1);
  if (area == 0) {  // as in our own meshes: no surface, and no normal to shade it by
    mesh.triangles.pop_back();
    return;
  }
  mesh.organ_of_triangle.push_back(organ);
  mesh.organs[organ].area_m2 += area;
}

struct AxisRing {
  Eigen::Vector3d centre, x, y;  // x, y: the circle's axes, y stretched where the joint cuts it slantwise
};

class AxisSweep {
 public:
  AxisSweep(const std::vector<AxisNode>& nodes, const std::vector<std::uint32_t>& organs,
            const AxisMeshOptions& options, Mesh& mesh)
      : nodes_(nodes), organs_(organs), options_(options), mesh_(mesh) {
    double widest = 0;
    for (const AxisNode& node : nodes) widest = std::max(widest, node.radius_m);
    constexpr int least_sides = 6, most_sides = 64;
    sides_ = circle_sides(widest, options.tolerance_m, least_sides, most_sides);
  }

  void add() {
    std::vector<Eigen::Vector3d> direction;
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
      const Eigen::Vector3d d = nodes_[i + 1].position_m - nodes_[i].position_m;
      direction.push_back(d.norm() > 0        ? d.normalized()
                          : direction.empty() ? Eigen::Vector3d::UnitZ()
                                              : direction.back());
    }
    Eigen::Vector3d x = direction[0].unitOrthogonal();
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
      if (i > 0)  // carried along without a twist
        x = Eigen::Quaterniond::FromTwoVectors(direction[i - 1], direction[i]) * x;
      const AxisRing low = ring(i, i > 0 ? direction[i - 1] : direction[i], direction[i], x, direction[i]);
      const AxisRing high = ring(i + 1, direction[i],
                                 i + 1 < direction.size() ? direction[i + 1] : direction[i], x, direction[i]);
      wall(i, low, high, direction[i], x);
      if (i == 0 && options_.close_base) lid(low, -direction[i], organs_[i], 0);
      if (i + 2 == nodes_.size() && options_.close_tip) lid(high, direction[i], organs_[i], 1);
    }
  }

 private:
  // The circle across `along`, slid along it onto the plane that halves the angle between the neighbours.
  AxisRing ring(std::size_t node, const Eigen::Vector3d& before, const Eigen::Vector3d& after,
                const Eigen::Vector3d& x, const Eigen::Vector3d& along) const {
    const double stretch = (pi / sides_) / std::sin(pi / sides_) * nodes_[node].radius_m;
    const Eigen::Vector3d y = along.cross(x);
    AxisRing out{nodes_[node].position_m, stretch * x, stretch * y};
    const Eigen::Vector3d plane = before + after;
    const double facing = plane.dot(along);
    constexpr double sharpest = 0.5;  // a mitre further than 60 degrees would reach too far: cut straight
    if (facing > sharpest * plane.norm()) {
      out.x -= (out.x.dot(plane) / facing) * along;
      out.y -= (out.y.dot(plane) / facing) * along;
    }
    return out;
  }

  static Eigen::Vector3d on(const AxisRing& ring, double angle) {
    return ring.centre + std::cos(angle) * ring.x + std::sin(angle) * ring.y;
  }

  void wall(std::size_t i, const AxisRing& low, const AxisRing& high, const Eigen::Vector3d& along,
            const Eigen::Vector3d& x) {
    const double length = (nodes_[i + 1].position_m - nodes_[i].position_m).norm();
    const double slope = length > 0 ? (nodes_[i].radius_m - nodes_[i + 1].radius_m) / length : 0;
    const Eigen::Vector3d y = along.cross(x);
    std::uint32_t before[2] = {0, 0};
    for (int j = 0; j <= sides_; ++j) {
      const double angle = 2 * pi * (j % sides_) / sides_, v = static_cast<double>(j) / sides_;
      const Eigen::Vector3d normal = (std::cos(angle) * x + std::sin(angle) * y + slope * along).normalized();
      const std::uint32_t a = add_axis_vertex(on(low, angle), normal, 0, v, mesh_);
      const std::uint32_t b = add_axis_vertex(on(high, angle), normal, 1, v, mesh_);
      if (j > 0) {
        add_axis_triangle(before[0], a, b, organs_[i], mesh_);
        add_axis_triangle(before[0], b, before[1], organs_[i], mesh_);
      }
      before[0] = a;
      before[1] = b;
    }
  }

  void lid(const AxisRing& ring, const Eigen::Vector3d& normal, std::uint32_t organ, double u) {
    const std::uint32_t centre = add_axis_vertex(ring.centre, normal, u, 0.5, mesh_);
    for (int j = 0; j <= sides_; ++j) {
      add_axis_vertex(on(ring, 2 * pi * (j % sides_) / sides_), normal, u, static_cast<double>(j) / sides_,
                      mesh_);
      const std::uint32_t now = centre + 1 + static_cast<std::uint32_t>(j);
      if (j > 0 && u > 0) add_axis_triangle(centre, now - 1, now, organ, mesh_);
      if (j > 0 && u == 0) add_axis_triangle(centre, now, now - 1, organ, mesh_);
    }
  }

  const std::vector<AxisNode>& nodes_;
  const std::vector<std::uint32_t>& organs_;
  const AxisMeshOptions& options_;
  Mesh& mesh_;
  int sides_ = 6;
};

}  // namespace

void add_axis(const std::vector<AxisNode>& nodes, const std::vector<std::uint32_t>& organs,
              const AxisMeshOptions& options, Mesh& mesh) {
  if (nodes.size() >= 2) AxisSweep(nodes, organs, options, mesh).add();
}

void add_blade(const Eigen::Vector3d& base, const Eigen::Vector3d& along, const Eigen::Vector3d& across,
               std::uint32_t organ, Mesh& mesh) {
  // Widths that make the strip's area that of the parabola: Simpson's rule is exact for it, the trapezium
  // rule is short by 1 / rows^2.
  constexpr int rows = 8;
  const double fill = 1 / (1 - 1.0 / (rows * rows));
  const Eigen::Vector3d cross = across.cross(along);
  const Eigen::Vector3d normal =
      cross.norm() > 0 ? Eigen::Vector3d(-cross.normalized()) : Eigen::Vector3d::UnitZ();
  std::uint32_t left = 0, right = 0;
  for (int i = 0; i <= rows; ++i) {
    const double l = static_cast<double>(i) / rows, width = fill * 4 * l * (1 - l);
    const std::uint32_t a = add_axis_vertex(base + l * along - width * across, normal, l, 0, mesh);
    const std::uint32_t b = add_axis_vertex(base + l * along + width * across, normal, l, 1, mesh);
    if (i > 0) {
      add_axis_triangle(left, a, b, organ, mesh);
      add_axis_triangle(left, b, right, organ, mesh);
    }
    left = a;
    right = b;
  }
}

void add_polygon(const std::vector<Eigen::Vector3d>& corners, std::uint32_t organ, Mesh& mesh) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double farthest = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (i > 1) normal += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
    farthest = std::max(farthest, (corners[i] - corners[0]).norm());
  }
  normal = normal.norm() > 0 ? Eigen::Vector3d(normal.normalized()) : Eigen::Vector3d::UnitZ();
  const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    add_axis_vertex(corners[i], normal, farthest > 0 ? (corners[i] - corners[0]).norm() / farthest : 0, 0.5,
                    mesh);
    if (i > 1)
      add_axis_triangle(first, first + static_cast<std::uint32_t>(i) - 1,
                        first + static_cast<std::uint32_t>(i), organ, mesh);
  }
}

}  // namespace bpms
