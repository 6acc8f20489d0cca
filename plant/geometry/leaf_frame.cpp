#include "plant/leaf_frame.h"

#include <algorithm>
#include <cmath>

#include "plant/geometry/gauss_legendre.h"

namespace bpms {
namespace {

double at(const std::unique_ptr<OrganFunction>& function, double l) {
  return function ? function->value(l) : 0.0;
}

Eigen::Vector3d tangent(const OrganAttributes& organ, double l) {
  const double inclination = at(organ.f_inclination, l);
  const double azimuth = at(organ.f_azimuth, l);
  return {std::cos(azimuth) * std::sin(inclination), -std::sin(azimuth),
          std::cos(azimuth) * std::cos(inclination)};
}

Eigen::Vector3d gauss(const OrganAttributes& organ, double from, double to) {
  const double half = (to - from) / 2;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const GaussNode& node : gauss_legendre_8)
    sum += node.weight * tangent(organ, from + half * (1 + node.x));
  return half * sum;
}

// Halves the interval until halves and whole agree; `whole` is the integral over it by one rule.
Eigen::Vector3d integrate(const OrganAttributes& organ, double from, double to, const Eigen::Vector3d& whole,
                          int depth) {
  constexpr double tolerance = 1e-11;
  const double middle = (from + to) / 2;
  const Eigen::Vector3d left = gauss(organ, from, middle);
  const Eigen::Vector3d right = gauss(organ, middle, to);
  if (depth == 0 || (left + right - whole).cwiseAbs().maxCoeff() < tolerance) return left + right;
  return integrate(organ, from, middle, left, depth - 1) + integrate(organ, middle, to, right, depth - 1);
}

}  // namespace

Eigen::Matrix3d organ_rotation(double inclination, double azimuth, double twist) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(inclination, Vector3d::UnitY()) * AngleAxisd(azimuth, Vector3d::UnitX()) *
          AngleAxisd(twist, Vector3d::UnitZ()))
      .toRotationMatrix();
}

Eigen::Matrix3d organ_frame(const OrganAttributes& organ, double l) {
  return organ_rotation(at(organ.f_inclination, l), at(organ.f_azimuth, l), at(organ.f_twist, l));
}

std::vector<double> organ_breaks(const OrganAttributes& organ) {
  std::vector<double> out;
  for (const auto* function :
       {&organ.f_inclination, &organ.f_azimuth, &organ.f_twist, &organ.f_curvature, &organ.f_width}) {
    if (!*function) continue;
    const std::vector<double> breaks = (*function)->breaks();
    out.insert(out.end(), breaks.begin(), breaks.end());
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<MidribPoint> midrib(const OrganAttributes& organ, const std::vector<double>& l) {
  constexpr int deepest = 18;
  const std::vector<double> breaks = organ_breaks(organ);
  auto next_break = breaks.begin();
  const bool straight = !organ.f_inclination && !organ.f_azimuth;
  std::vector<MidribPoint> out;
  out.reserve(l.size());
  double from = 0;
  Eigen::Vector3d at_from = Eigen::Vector3d::Zero();  // of unit length
  const auto advance = [&](double to) {
    if (to == from) return;
    at_from += straight ? Eigen::Vector3d((to - from) * Eigen::Vector3d::UnitZ())
                        : integrate(organ, from, to, gauss(organ, from, to), deepest);
    from = to;
  };
  for (const double to : l) {
    for (; next_break != breaks.end() && *next_break < to; ++next_break) {
      if (*next_break > from) advance(*next_break);
    }
    advance(to);
    out.push_back({to, organ.length_m * at_from, organ_frame(organ, to)});
  }
  return out;
}

}  // namespace bpms
