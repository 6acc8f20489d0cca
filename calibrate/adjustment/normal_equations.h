// The linearised adjustment at its solution, board poses eliminated frame by frame (Schur complement): what
// the iid covariance, the covariance clustered by frame and the test of convergence are made from.
#pragma once
#include <string>
#include <vector>

#include "calibrate/adjustment/bundle_adjustment.h"

namespace bpms {

// Free parameters in order: camera by camera its lens parameters, then rotation vector (left perturbation)
// and translation of all cameras but the first; the board's bending last when it is free.
struct NormalEquations {
  std::vector<std::string> order;  // without the bending
  int bending = 0;                 // 0 or 2 more columns
  Eigen::MatrixXd information;     // J'J with the poses eliminated, for residuals in pixels
  struct Frame {
    int frame = 0;
    Eigen::VectorXd score;  // J'r of this frame alone, its pose eliminated
  };
  std::vector<Frame> frames;    // those with corners
  Eigen::VectorXd known_score;  // of the lens models' priors
  double squared_residuals = 0;
  double pose_decrement =
      0;                 // what a Gauss-Newton step of the poses alone would take off the squared residuals
  int observations = 0;  // two each corner
  int parameters = 0;    // all free ones, poses included

  Eigen::VectorXd score() const;
  double rms_px() const;
  double sigma_px() const;  // with degrees of freedom; 0 when there are none left
};

NormalEquations normal_equations(const BundleProblem& problem, const BundleState& state);

// inverse(information), of all columns; numeric error when the views do not determine the parameters, which
// names the worst determined one.
Eigen::MatrixXd cofactors(const NormalEquations& equations);

// Sandwich by frame: C (sum s_f s_f') C F/(F-1), C the cofactors.
Eigen::MatrixXd sandwich(const NormalEquations& equations, const Eigen::MatrixXd& cofactors);

}  // namespace bpms
