// The linearised adjustment at its solution. What belongs to one frame alone (the pose of the rig or of a
// board in it), or to one point of nature, is eliminated (Schur complement); what is kept makes the
// covariances, iid and clustered by frame, and the test of convergence.
#pragma once
#include <string>
#include <vector>

#include "calibrate/adjustment/network.h"

namespace bpms {

// Kept parameters in order: camera by camera its lens parameters, then rotation vector (left perturbation)
// and translation of all cameras but the first: these are the rig's, named in `order`. Then bendings, poses
// of what stands, points, and the rig's poses where points of nature tie frames together.
struct NormalEquations {
  std::vector<std::string> order;  // of the rig's
  std::vector<std::string> names;  // of all that are kept
  Eigen::MatrixXd information;     // J'J, the others eliminated, for residuals in pixels
  Eigen::MatrixXd believed;        // the part of it that is belief in a lens model's smoothness
  struct Frame {
    int frame = 0;
    Eigen::VectorXd score;  // J'r of this frame alone, the others eliminated
  };
  std::vector<Frame> frames;     // those with corners
  Eigen::VectorXd known_score;   // of what is known beforehand
  double squared_residuals = 0;  // of corners and of what is known beforehand
  double corner_squares = 0;
  double pose_decrement =
      0;  // what a Gauss-Newton step of the eliminated alone would take off the squared residuals
  int observations = 0;  // two each corner, and what is known beforehand
  int coordinates = 0;   // two each corner
  int parameters = 0;    // all free ones, less those that belief determines

  Eigen::VectorXd score() const;
  double rms_px() const;    // of the corners
  double sigma_px() const;  // with degrees of freedom; 0 when there are none left
};

NormalEquations normal_equations(const BundleProblem& problem, const BundleState& state);

// inverse(information), of all columns; numeric error when the views do not determine the parameters, which
// names the worst determined one.
Eigen::MatrixXd cofactors(const NormalEquations& equations);

// Sandwich by frame: C (sum s_f s_f') C F/(F-1), C the cofactors.
Eigen::MatrixXd sandwich(const NormalEquations& equations, const Eigen::MatrixXd& cofactors);

}  // namespace bpms
