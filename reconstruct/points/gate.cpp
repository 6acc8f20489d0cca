#include "reconstruct/points/gate.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>

namespace bpms {

GateResult gate(const Eigen::VectorXd& residual, const Eigen::MatrixXd& by_point,
                const Eigen::MatrixXd& by_rig, const Eigen::MatrixXd& rig_covariance) {
  const Eigen::Index dof = residual.size() - by_point.cols();
  const Eigen::MatrixXd basis = Eigen::HouseholderQR<Eigen::MatrixXd>(by_point).householderQ();
  const Eigen::MatrixXd null_space = basis.rightCols(dof);
  const Eigen::VectorXd e = null_space.transpose() * residual;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(dof, dof);
  if (by_rig.cols() > 0) {
    const Eigen::MatrixXd g = null_space.transpose() * by_rig;
    covariance += g * rig_covariance * g.transpose();
  }
  GateResult out;
  out.chi2 = e.dot(covariance.ldlt().solve(e));
  out.dof = static_cast<int>(dof);
  out.p = chi_squared_tail(out.chi2, out.dof);
  return out;
}

// Q(k + 2) = Q(k) + (x/2)^(k/2) e^(-x/2) / Gamma(k/2 + 1), from Q(1) = erfc(sqrt(x/2)) or Q(2) = e^(-x/2)
// (Abramowitz & Stegun 26.4.4, 26.4.5).
double chi_squared_tail(double x, int dof) {
  if (x <= 0) return 1;
  const double half = x / 2;
  const bool odd = dof % 2 == 1;
  double tail = odd ? std::erfc(std::sqrt(half)) : std::exp(-half);
  for (int k = odd ? 1 : 2; k < dof; k += 2)
    tail += std::exp(0.5 * k * std::log(half) - half - std::lgamma(0.5 * k + 1));
  return std::min(tail, 1.0);
}

}  // namespace bpms
