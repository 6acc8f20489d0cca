// Volume, area and centroid of swept bodies. With the frame turning at the rate w per l, a point rho off the
// midrib moves by L + (w x rho)_z along it: the volume is L pi r^2 a step whatever the bend (Pappus), its
// first moment L pi r^2 x + (pi r^4 / 4) (-w_y, w_x, 0).
#include <Eigen/Geometry>
#include <cmath>

#include "core/units.h"
#include "plant/geometry/frame_rate.h"
#include "plant/geometry/gauss_legendre.h"
#include "plant/geometry/swept_body.h"
#include "plant/leaf_frame.h"

namespace bpms {
namespace {

// The side's area a step of u; the mean around the circle by the trapezoidal rule, which converges fast.
double side_area_rate_m2(const SweptBody& body, const Ring& ring) {
  constexpr int around = 16;
  const double length = body.length_m * ring.l_rate;
  if (ring.rate.x() == 0 && ring.rate.y() == 0 && ring.rate.z() == 0)
    return 2 * pi * ring.radius_m * std::hypot(length, ring.radius_rate_m);
  double sum = 0;
  for (int j = 0; j < around; ++j) {
    const double angle = 2 * pi * (j + 0.5) / around;
    const Eigen::Vector3d radial(std::cos(angle), std::sin(angle), 0);
    const Eigen::Vector3d across(-radial.y(), radial.x(), 0);
    const Eigen::Vector3d along = Eigen::Vector3d(0, 0, length) +
                                  ring.l_rate * ring.rate.cross(ring.radius_m * radial) +
                                  ring.radius_rate_m * radial;
    sum += across.cross(along).norm();
  }
  return 2 * pi * ring.radius_m * sum / around;
}

double disc_area_m2(const Ring& ring) {
  return pi * ring.radius_m * ring.radius_m;
}

}  // namespace

MassProperties swept_mass(const SweptBody& body) {
  MassProperties out;
  if (body.empty()) return out;
  // Between kinks the functions are smooth; a rounded body's are in u all over.
  std::vector<double> ends{0};
  for (const double l : organ_breaks(*body.organ))
    ends.push_back(body.rounded ? std::acos(1 - 2 * l) / pi : l);
  ends.push_back(1);
  const bool plain = body.is_straight() && !body.organ->f_width && !body.organ->f_twist && !body.rounded;
  const int panels = plain ? 1 : body.is_straight() ? 2 : 4;
  std::vector<double> u, weights;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double step = (ends[i + 1] - ends[i]) / panels;
    for (int p = 0; p < panels; ++p)
      for (const GaussNode& node : gauss_legendre_8) {
        u.push_back(ends[i] + step * (p + (1 + node.x) / 2));
        weights.push_back(step / 2 * node.weight);
      }
  }
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  const std::vector<Ring> all = rings(body, u);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Ring& ring = all[k];
    const double disc = disc_area_m2(ring);
    const double step = weights[k] * ring.l_rate;
    const Eigen::Vector3d lean(-ring.rate.y(), ring.rate.x(), 0);
    out.volume_m3 += step * body.length_m * disc;
    moment += step * (body.length_m * disc * ring.centre_m +
                      disc * ring.radius_m * ring.radius_m / 4 * (ring.frame * lean));
    out.area_m2 += weights[k] * side_area_rate_m2(body, ring);
  }
  if (!body.rounded) {
    const std::vector<Ring> lids = rings(body, {0, 1});
    out.area_m2 += disc_area_m2(lids[0]) + disc_area_m2(lids[1]);
  }
  if (out.volume_m3 > 0) out.centroid_m = moment / out.volume_m3;
  return out;
}

double joint_radius_m(const OrganAttributes& stem) {
  const double width = stem.f_width ? std::max(0.0, stem.f_width->value(1)) : 1.0;
  return stem.joint * width * stem.radius_m;
}

MassProperties organ_mass(OrganKind kind, const OrganAttributes& organ) {
  MassProperties out = swept_mass(swept_body(kind, organ));
  const double ball = joint_radius_m(organ);
  if (!(ball > 0)) return out;
  const double r = ball / organ.joint;  // the stem's, there
  // What the two share lies below the tip: a cylinder up to where it leaves the ball, and the rest of the
  // ball.
  const double h = ball > r ? std::sqrt(ball * ball - r * r) : 0;
  const double cap = pi * (ball - h) * (ball - h) * (2 * ball + h) / 3;
  const double shared = pi * r * r * h + cap;
  const double shared_moment =
      pi * r * r * h * h / 2 + pi * (std::pow(ball, 4) / 4 - ball * ball * h * h / 2 + std::pow(h, 4) / 4);
  const double whole = 4 * pi / 3 * std::pow(ball, 3);
  const MidribPoint tip = midrib(organ, {1.0}).back();
  const Eigen::Vector3d moment =
      out.volume_m3 * out.centroid_m + (whole - shared) * tip.x_m + shared_moment * tip.frame.col(2);
  out.area_m2 += 4 * pi * ball * ball;
  out.volume_m3 += whole - shared;
  out.centroid_m = moment / out.volume_m3;
  return out;
}

}  // namespace bpms
