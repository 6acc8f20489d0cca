#include "plant/structure/de_wit.h"

#include <cmath>

#include "core/units.h"
#include "plant/structure/mean_projection.h"

namespace bpms {
namespace {

struct Harmonics {
  double a, b;
};
Harmonics harmonics(LeafAngles angles) {
  switch (angles) {
    case LeafAngles::planophile:
      return {1, 0};
    case LeafAngles::erectophile:
      return {-1, 0};
    case LeafAngles::plagiophile:
      return {0, -1};
    case LeafAngles::extremophile:
      return {0, 1};
    default:
      return {0, 0};
  }
}

}  // namespace

std::string name_of(LeafAngles angles) {
  switch (angles) {
    case LeafAngles::spherical:
      return "spherical";
    case LeafAngles::planophile:
      return "planophile";
    case LeafAngles::erectophile:
      return "erectophile";
    case LeafAngles::plagiophile:
      return "plagiophile";
    case LeafAngles::extremophile:
      return "extremophile";
    default:
      return "uniform";
  }
}

double leaf_angle_density(LeafAngles angles, double t) {
  if (angles == LeafAngles::spherical) return std::sin(t);
  const Harmonics h = harmonics(angles);
  return 2 / pi * (1 + h.a * std::cos(2 * t) + h.b * std::cos(4 * t));
}

double leaf_angle_cumulative(LeafAngles angles, double t) {
  if (angles == LeafAngles::spherical) return 1 - std::cos(t);
  const Harmonics h = harmonics(angles);
  return 2 / pi * (t + h.a * std::sin(2 * t) / 2 + h.b * std::sin(4 * t) / 4);
}

double leaf_angle_quantile(LeafAngles angles, double u) {
  if (angles == LeafAngles::spherical) return std::acos(1 - u);
  double low = 0, high = pi / 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (leaf_angle_cumulative(angles, middle) < u ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double g_function(LeafAngles angles, double zenith) {
  if (angles == LeafAngles::spherical) return 0.5;
  // Simpson on both sides of the kink of the projection at l = pi/2 - t.
  const double kink = pi / 2 - zenith;
  const auto integral = [&](double from, double to) {
    constexpr int steps = 400;
    const double h = (to - from) / steps;
    double sum = 0;
    for (int i = 0; i <= steps; ++i) {
      const double l = from + i * h;
      const double weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
      sum += weight * leaf_angle_density(angles, l) * mean_projection(l, zenith);
    }
    return sum * h / 3;
  };
  return integral(0, kink) + integral(kink, pi / 2);
}

}  // namespace bpms
