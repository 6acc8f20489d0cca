#include "plant/structure/mean_projection.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace bpms {

double mean_projection(double leaf_angle, double zenith) {
  const double a = std::cos(zenith) * std::cos(leaf_angle);
  const double b = std::sin(zenith) * std::sin(leaf_angle);
  if (b <= std::abs(a)) return std::abs(a);  // the leaf shows one side whatever its azimuth
  const double psi = std::acos(std::clamp(-a / b, -1.0, 1.0));
  return (a * (2 * psi - pi) + 2 * b * std::sin(psi)) / pi;
}

}  // namespace bpms
