#include "calibrate/pose.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

namespace bpms {

Eigen::Matrix3d rotation_from_vector(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Eigen::Vector3d vector_from_rotation(const Eigen::Matrix3d& r) {
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(r).normalized());
  return turn.angle() > EIGEN_PI ? Eigen::Vector3d((turn.angle() - 2 * EIGEN_PI) * turn.axis())
                                 : Eigen::Vector3d(turn.angle() * turn.axis());
}

Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const Eigen::Matrix3d x = cross_matrix(w);
  constexpr double small = 1e-4;  // the next terms of the series are angle^2/24 and angle^2/120 of these
  if (angle < small) return Eigen::Matrix3d::Identity() + 0.5 * x + x * x / 6;
  const double a2 = angle * angle;
  return Eigen::Matrix3d::Identity() + (1 - std::cos(angle)) / a2 * x +
         (angle - std::sin(angle)) / (a2 * angle) * x * x;
}

Eigen::Matrix3d orthonormalised(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace bpms
