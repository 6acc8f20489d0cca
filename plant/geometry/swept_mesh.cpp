// Stems, heads and buds: a circle swept along the organ's midrib, closed at both ends.
// A stem's radius is a_radius * f_width(l), its ends are flat. A bud is the sphere of a_radius; a head
// without f_width is the spheroid of a_length and a_radius bent along its midrib; with f_width it is like a
// stem.
#include <Eigen/Geometry>
#include <cmath>

#include "core/units.h"
#include "plant/geometry/frame_rate.h"
#include "plant/geometry/mesh_parts.h"
#include "plant/geometry/subdivide.h"
#include "plant/leaf_frame.h"

namespace bpms {
namespace {

// A ring of the body. The parameter u runs over [0, 1]; rounded bodies use l = (1 - cos(pi u)) / 2, radius ~
// sin(pi u), whose rows crowd towards the poles, elsewhere l = u.
struct Ring {
  double l = 0;
  Eigen::Vector3d centre_m;
  Eigen::Matrix3d frame;
  Eigen::Vector3d rate;  // of the frame, by l
  double radius_m = 0;
  double l_rate = 0, radius_rate_m = 0;  // by u
};

struct Body {
  OrganAttributes organ;
  bool rounded = false;
};

std::vector<Ring> rings(const Body& body, const std::vector<double>& u) {
  std::vector<double> l;
  for (const double value : u) l.push_back(body.rounded ? (1 - std::cos(pi * value)) / 2 : value);
  std::vector<Ring> out;
  const std::vector<MidribPoint> points = midrib(body.organ, l);
  for (std::size_t i = 0; i < u.size(); ++i) {
    Ring ring;
    ring.l = l[i];
    ring.centre_m = points[i].x_m;
    ring.frame = points[i].frame;
    ring.rate = frame_rate(body.organ, l[i]);
    const double radius = body.organ.radius_m;
    if (body.rounded) {
      ring.radius_m = u[i] == 0 || u[i] == 1 ? 0 : radius * std::sin(pi * u[i]);
      ring.l_rate = pi / 2 * std::sin(pi * u[i]);
      ring.radius_rate_m = radius * pi * std::cos(pi * u[i]);
    } else {
      const double fraction = body.organ.f_width ? body.organ.f_width->value(l[i]) : 1.0;
      ring.radius_m = radius * std::max(0.0, fraction);
      ring.l_rate = 1;
      ring.radius_rate_m =
          fraction > 0 && body.organ.f_width ? radius * body.organ.f_width->derivative(l[i]) : 0.0;
    }
    out.push_back(ring);
  }
  return out;
}

Eigen::Vector3d direction(double angle) {
  return {std::cos(angle), std::sin(angle), 0};
}

Eigen::Vector3d outward_normal(const Ring& ring, double length_m, double angle) {
  const Eigen::Vector3d radial = direction(angle);
  const Eigen::Vector3d around(-std::sin(angle), std::cos(angle), 0);
  const Eigen::Vector3d along =
      ring.l_rate * (Eigen::Vector3d(0, 0, length_m) + ring.rate.cross(ring.radius_m * radial)) +
      ring.radius_rate_m * radial;
  const Eigen::Vector3d normal = around.cross(along);
  return ring.frame * (normal.norm() > 1e-12 ? normal.normalized() : radial);
}

double deviation_m(const Ring* rings) {
  double worst = 0;
  for (int j = 0; j < 8; ++j) {
    const Eigen::Vector3d radial = direction(j * pi / 4);
    const auto point = [&](int k) {
      return Eigen::Vector3d(rings[k].centre_m + rings[k].frame * (rings[k].radius_m * radial));
    };
    for (int k = 1; k <= 3; ++k) worst = std::max(worst, distance_from_line(point(k), point(0), point(4)));
  }
  return worst;
}

class Sweeper {
 public:
  Sweeper(const Body& body, int sides) : body_(body), sides_(sides) {}

  OrganMesh mesh(const std::vector<double>& nodes, double point_below_m) {
    const std::vector<Ring> all = rings(body_, nodes);
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
    return ring.centre_m + ring.frame * (stretch * ring.radius_m * direction(angle(j)));
  }
  double angle(int j) const { return 2 * pi * (j % sides_) / sides_; }

  VertexRow add_ring(const Ring& ring) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions_m.size());
    for (int j = 0; j <= sides_; ++j)
      mesh_.add(vertex(ring, j), outward_normal(ring, body_.organ.length_m, angle(j)), ring.l,
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

  const Body& body_;
  int sides_;
  OrganMesh mesh_;
};

}  // namespace

OrganMesh swept_mesh(OrganKind kind, const OrganAttributes& organ, double tolerance_m) {
  constexpr int least_sides = 6, most_sides = 128, least_round_rows = 12;
  Body body{organ, kind == OrganKind::bud || (kind == OrganKind::head && !organ.f_width)};
  if (kind == OrganKind::bud) body.organ.length_m = 2 * organ.radius_m;
  if (body.organ.length_m <= 0 || organ.radius_m <= 0) return {};
  const double least_gap = std::clamp(0.1 * tolerance_m / body.organ.length_m, 1e-6, 1e-2);
  std::vector<double> nodes = body.rounded ? std::vector<double>{} : first_nodes(body.organ, least_gap);
  for (int i = 0; body.rounded && i <= least_round_rows; ++i)
    nodes.push_back(static_cast<double>(i) / least_round_rows);
  const auto rows = [&](const std::vector<double>& u) { return rings(body, u); };
  nodes = subdivide(
      std::move(nodes), rows, [](const Ring* five) { return deviation_m(five); }, tolerance_m / 2, least_gap);
  double widest = 0;
  for (const Ring& ring : rings(body, nodes)) widest = std::max(widest, ring.radius_m);
  const double sagitta = std::min(1.0, tolerance_m / 2 / std::max(widest, 1e-9));
  const int sides =
      std::clamp(static_cast<int>(std::ceil(pi / std::acos(1 - sagitta))), least_sides, most_sides);
  return Sweeper(body, sides).mesh(nodes, std::max(1e-5 * organ.radius_m, 1e-7));
}

}  // namespace bpms
