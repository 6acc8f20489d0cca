// The angles that formulas of soils are written in.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace bpms {

struct ReflectionAngles {
  double mu_view, mu_light;  // cosines of the zenith angles
  double cos_phase;          // of the angle between view and light: 1 in the hot spot
  double cos_azimuth;        // of the azimuth between them
  double distance;           // G = sqrt(tan^2 a + tan^2 b - 2 tan a tan b cos(azimuth)), 0 in the hot spot
};

// Unit vectors away from the surface, both with z > 0. Relative azimuth 0 is the view on the light's side.
// G is the distance of two points of the plane z = 1, which does not lose its digits in the hot spot.
inline ReflectionAngles reflection_angles(const Eigen::Vector3d& view, const Eigen::Vector3d& light) {
  const Eigen::Vector2d apart = view.head<2>() / view.z() - light.head<2>() / light.z();
  const double sines = view.head<2>().norm() * light.head<2>().norm();
  const double along = view.head<2>().dot(light.head<2>());
  return {view.z(), light.z(), std::clamp(view.dot(light), -1.0, 1.0),
          sines > 0 ? std::clamp(along / sines, -1.0, 1.0) : 1.0, apart.norm()};
}

}  // namespace bpms
