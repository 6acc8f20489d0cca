// The triangles of stems, heads and buds, closed at both ends.
#include <Eigen/Geometry>
#include <cmath>

#include "core/units.h"
#include "plant/geometry/mesh_parts.h"
#include "plant/geometry/subdivide.h"
#include "plant/geometry/swept_body.h"

namespace bpms {
namespace {

Eigen::Vector3d radial_direction(double angle) {
  return {std::cos(angle), std::sin(angle), 0};
}

Eigen::Vector3d outward_normal(const Ring& ring, double length_m, double angle) {
  const Eigen::Vector3d radial = radial_direction(angle);
  const Eigen::Vector3d around(-std::sin(angle), std::cos(angle), 0);
  const Eigen::Vector3d along =
      ring.l_rate * (Eigen::Vector3d(0, 0, length_m) + ring.rate.cross(ring.radius_m * radial)) +
      ring.radius_rate_m * radial;
  const Eigen::Vector3d normal = around.cross(along);
  return ring.frame * (normal.norm() > 1e-12 ? normal.normalized() : radial);
}

class Sweeper {
 public:
  Sweeper(const SweptBody& body, int sides) : body_(body), sides_(sides) {}

  OrganMesh mesh(const std::vector<Ring>& all, double point_below_m) {
    const std::size_t around = static_cast<std::size_t>(sides_) + 1;
    mesh_.reserve(around * (all.size() + 2) + 2, 2 * around * (all.size() + 1));
    VertexRow before{};
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool point = all[i].radius_m <= point_below_m;
      const VertexRow row = point ? add_point(all[i], i == 0 ? -1 : 1) : add_ring(all[i]);
      if (i > 0) join_outward(before, row);
      if (!point && i == 0) close(all[i], -1);
      if (!point && i + 1 == all.size()) close(all[i], 1);
      before = row;
    }
    return std::move(mesh_);
  }

 private:
  // Stretched so that the polygon is as long as the circle; the last vertex of a ring repeats the first, with
  // V = 1.
  Eigen::Vector3d vertex(const Ring& ring, int j) const {
    const double stretch = (pi / sides_) / std::sin(pi / sides_);
    return ring.centre_m + ring.frame * (stretch * ring.radius_m * radial_direction(angle(j)));
  }
  double angle(int j) const { return 2 * pi * (j % sides_) / sides_; }

  VertexRow add_ring(const Ring& ring) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions_m.size());
    for (int j = 0; j <= sides_; ++j)
      mesh_.add(vertex(ring, j), outward_normal(ring, body_.length_m, angle(j)), ring.l,
                static_cast<double>(j) / sides_);
    return {first, static_cast<std::uint32_t>(sides_) + 1};
  }
  VertexRow add_point(const Ring& ring, int sign) {
    return {mesh_.add(ring.centre_m, sign * ring.frame.col(2), ring.l, 0.5), 1};
  }

  // Rows run around counter-clockwise, so that (next - row) x (across) looks inwards: turn the triangles
  // over.
  void join_outward(const VertexRow& row, const VertexRow& next) {
    const std::size_t from = mesh_.triangles.size();
    join_rows(mesh_, row, next);
    for (std::size_t t = from; t < mesh_.triangles.size(); ++t)
      std::swap(mesh_.triangles[t][1], mesh_.triangles[t][2]);
  }

  // A flat lid with vertices of its own: its normal is not the wall's.
  void close(const Ring& ring, int sign) {
    const Eigen::Vector3d normal = sign * ring.frame.col(2);
    const std::uint32_t centre = mesh_.add(ring.centre_m, normal, ring.l, 0.5);
    for (int j = 0; j <= sides_; ++j)
      mesh_.add(vertex(ring, j), normal, ring.l, static_cast<double>(j) / sides_);
    for (int j = 0; j < sides_; ++j) {
      const auto a = centre + 1 + static_cast<std::uint32_t>(j);
      if (sign > 0)
        mesh_.triangles.push_back({centre, a, a + 1});
      else
        mesh_.triangles.push_back({centre, a + 1, a});
    }
  }

  const SweptBody& body_;
  int sides_;
  OrganMesh mesh_;
};

}  // namespace

OrganMesh swept_mesh(OrganKind kind, const OrganAttributes& organ, double tolerance_m) {
  constexpr int least_sides = 6, most_sides = 128;
  const SweptBody body = swept_body(kind, organ);
  if (body.empty()) return {};
  const std::vector<Ring> nodes = ring_nodes(body, tolerance_m / 2);
  double widest = 0;
  for (const Ring& ring : nodes) widest = std::max(widest, ring.radius_m);
  const int sides = circle_sides(widest, tolerance_m / 2, least_sides, most_sides);
  return Sweeper(body, sides).mesh(nodes, body.point_below_m());
}

}  // namespace bpms
