#include "simulate/materials/bumped_normal.h"

#include <Eigen/Geometry>
#include <cmath>

namespace bpms {

Eigen::Vector3f bumped_normal(const Eigen::Vector3f& normal, const Eigen::Vector3f& dp_du,
                              const Eigen::Vector3f& dp_dv, const Eigen::Vector2f& slopes) {
  const float area = normal.dot(dp_du.cross(dp_dv));  // negative where U and V run the other way round
  // Of a sliver nothing is known but rounding.
  if (!(std::abs(area) > 1e-6f * dp_du.norm() * dp_dv.norm())) return normal;
  // The gradient's components along the basis that is dual to dp_du, dp_dv.
  const Eigen::Vector3f gradient =
      (slopes.x() * dp_dv.cross(normal) + slopes.y() * normal.cross(dp_du)) / area;
  return (normal - gradient).normalized();
}

}  // namespace bpms
