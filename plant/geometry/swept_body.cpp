#include "plant/geometry/swept_body.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/units.h"
#include "plant/geometry/frame_rate.h"
#include "plant/geometry/subdivide.h"
#include "plant/leaf_frame.h"

namespace bpms {
namespace {

double l_of(const SweptBody& body, double u) {
  return body.rounded ? (1 - std::cos(pi * u)) / 2 : u;
}

Ring ring_at(const SweptBody& body, double u, const Eigen::Vector3d& centre_m) {
  Ring ring;
  ring.u = u;
  ring.l = l_of(body, u);
  ring.centre_m = centre_m;
  const MovingFrame moving = moving_frame(*body.organ, ring.l);
  ring.frame = moving.frame;
  ring.rate = moving.rate;
  const double radius = body.organ->radius_m;
  if (body.rounded) {
    ring.radius_m = u == 0 || u == 1 ? 0 : radius * std::sin(pi * u);
    ring.l_rate = pi / 2 * std::sin(pi * u);
    ring.radius_rate_m = radius * pi * std::cos(pi * u);
    return ring;
  }
  const std::unique_ptr<OrganFunction>& width = body.organ->f_width;
  const double fraction = width ? width->value(ring.l) : 1.0;
  ring.radius_m = radius * std::max(0.0, fraction);
  ring.l_rate = 1;
  ring.radius_rate_m = fraction > 0 && width ? radius * width->derivative(ring.l) : 0.0;
  return ring;
}

double ring_deviation_m(const FiveRows<Ring>& five) {
  constexpr int around = 8;
  double worst = 0;
  for (int j = 0; j < around; ++j) {
    const double angle = j * 2 * pi / around;
    const Eigen::Vector3d radial(std::cos(angle), std::sin(angle), 0);
    const auto point = [&](std::size_t k) {
      return Eigen::Vector3d(five[k]->centre_m + five[k]->frame * (five[k]->radius_m * radial));
    };
    const Eigen::Vector3d first = point(0), last = point(4);
    for (std::size_t k = 1; k <= 3; ++k) worst = std::max(worst, distance_from_line(point(k), first, last));
  }
  return worst;
}

}  // namespace

SweptBody swept_body(OrganKind kind, const OrganAttributes& organ) {
  const bool bud = kind == OrganKind::bud;
  return {&organ, bud ? 2 * organ.radius_m : organ.length_m,
          bud || (kind == OrganKind::head && !organ.f_width)};
}

std::vector<Ring> rings(const SweptBody& body, const std::vector<double>& u) {
  std::vector<Ring> out;
  out.reserve(u.size());
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double from = 0;
  for (const double at : u) {
    const double l = l_of(body, at);
    centre += body.length_m * midrib_step(*body.organ, from, l);
    from = l;
    out.push_back(ring_at(body, at, centre));
  }
  return out;
}

std::vector<Ring> ring_nodes(const SweptBody& body, double tolerance_m) {
  constexpr int least_round_rows = 12;
  const double least_gap = std::clamp(0.2 * tolerance_m / body.length_m, 1e-6, 1e-2);
  std::vector<double> nodes = body.rounded ? std::vector<double>{} : first_nodes(*body.organ, least_gap);
  for (int i = 0; body.rounded && i <= least_round_rows; ++i)
    nodes.push_back(static_cast<double>(i) / least_round_rows);
  const auto between = [&](const Ring& a, const Ring& b) {
    const double u = (a.u + b.u) / 2;
    return ring_at(body, u,
                   a.centre_m + body.length_m * short_midrib_step(*body.organ, a.l, l_of(body, u), a.rate));
  };
  const auto gap = [](const Ring& a, const Ring& b) { return b.u - a.u; };
  return subdivide(rings(body, with_quarters(nodes)), between, gap, ring_deviation_m, tolerance_m, least_gap);
}

}  // namespace bpms
