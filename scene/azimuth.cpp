#include <cmath>

#include "scene/scene.h"

namespace bpms {

Eigen::Vector3d direction_from_angles(double zenith, double azimuth, const Domain& domain) {
  const double s = std::sin(zenith);
  const double z = std::cos(zenith);
  if (domain.azimuth_north_clockwise) return {s * std::sin(azimuth), s * std::cos(azimuth), z};
  return {s * std::cos(azimuth), s * std::sin(azimuth), z};
}

}  // namespace bpms
