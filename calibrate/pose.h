// Rigid motions and small rotations. Poses are perturbed from the left: R <- exp(w) R.
#pragma once
#include <Eigen/Core>

namespace bpms {

struct Pose {
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d operator*(const Eigen::Vector3d& x) const { return r * x + t_m; }
  Pose operator*(const Pose& first) const { return {r * first.r, r * first.t_m + t_m}; }
  Pose inverse() const { return {r.transpose(), -(r.transpose() * t_m)}; }
};

inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d out;
  out << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return out;
}
Eigen::Matrix3d rotation_from_vector(const Eigen::Vector3d& w);
Eigen::Vector3d vector_from_rotation(const Eigen::Matrix3d& r);  // angle in [0, pi]
// The left Jacobian of the rotation group: exp(w + d) = exp(J d) exp(w) to first order in d.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w);
// The nearest rotation.
Eigen::Matrix3d orthonormalised(const Eigen::Matrix3d& m);

}  // namespace bpms
