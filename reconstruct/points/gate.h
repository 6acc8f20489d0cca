// The gate for wrong correspondences: do the rays of a point meet within their errors?
//
// The whitened residuals r (2N) of a maximum-likelihood point lie in the left null space Q (2N x 2N-3) of the
// derivatives J. With rig errors b ~ (0, V) that move the pixels by G b, e = Q'r has covariance I + Q'G V
// G'Q, and chi2 = e' cov(e)^-1 e has 2N - 3 degrees of freedom: 1 for a stereo pair (the distance from the
// epipolar line).
#pragma once
#include <Eigen/Core>

namespace bpms {

struct GateResult {
  double chi2;
  int dof;
  double p;  // probability of a larger chi2
};

// `by_rig` and `rig_covariance` may have no columns: a rig without errors.
GateResult gate(const Eigen::VectorXd& residual, const Eigen::MatrixXd& by_point,
                const Eigen::MatrixXd& by_rig, const Eigen::MatrixXd& rig_covariance);

// P(chi-square with `dof` degrees of freedom > x).
double chi_squared_tail(double x, int dof);

}  // namespace bpms
