// Random numbers to directions and to points of a disc. All keep areas, so that evenly spread numbers stay
// evenly spread.
#pragma once
#include <Eigen/Core>
#include <cmath>

#include "core/units.h"

namespace bpms {

// On the unit disc, even. Concentric squares to circles: Shirley & Chiu 1997, J. Graphics Tools 2(3).
inline Eigen::Vector2d in_unit_disc(double u, double v) {
  const double x = 2 * u - 1, y = 2 * v - 1;
  if (x == 0 && y == 0) return {0, 0};
  if (std::abs(x) > std::abs(y)) {
    const double angle = pi / 4 * (y / x);
    return {x * std::cos(angle), x * std::sin(angle)};
  }
  const double angle = pi / 2 - pi / 4 * (x / y);
  return {y * std::cos(angle), y * std::sin(angle)};
}

// A unit vector and two across it, all at right angles.
struct Axes {
  explicit Axes(const Eigen::Vector3d& unit) : axis(unit) {  // Duff et al. 2017, JCGT 6(1)
    const double sign = std::copysign(1.0, unit.z());
    const double a = -1.0 / (sign + unit.z());
    const double b = unit.x() * unit.y() * a;
    across = {1.0 + sign * unit.x() * unit.x() * a, sign * b, -sign * unit.x()};
    along = {b, sign + unit.y() * unit.y() * a, -unit.y()};
  }
  Eigen::Vector3d axis, across, along;
};

// Density cos / pi about the axis.
inline Eigen::Vector3d cosine_about(const Axes& axes, double u, double v) {
  const Eigen::Vector2d at = in_unit_disc(u, v);
  const double up = std::sqrt(std::max(0.0, 1.0 - at.squaredNorm()));
  return (at.x() * axes.across + at.y() * axes.along + up * axes.axis).normalized();
}

// Even over the solid angle of a cone of this half-angle about the axis.
inline Eigen::Vector3d within_cone(const Axes& axes, double half_angle, double u, double v) {
  const Eigen::Vector2d at = in_unit_disc(u, v);
  const double half_sine = std::sin(0.5 * half_angle);
  // 1 - cos(angle) = 2 sin^2(angle / 2) is even; no cancellation for narrow cones.
  const double fraction = at.squaredNorm() * half_sine * half_sine;
  const double cosine = 1 - 2 * fraction;
  const double sine_by_radius = 2 * half_sine * std::sqrt(1 - fraction);
  return (sine_by_radius * (at.x() * axes.across + at.y() * axes.along) + cosine * axes.axis).normalized();
}

}  // namespace bpms
