// How sure the adjustment is, frame by frame: solves with one frame left out (jackknife), the sandwich
// covariance, and the two halves of the frames against each other.
#pragma once
#include "calibrate/adjustment/normal_equations.h"

namespace bpms {

// The pose of camera b seen from camera a.
Pose relative_pose(const std::vector<Camera>& cameras, int a, int b);
// d(baseline between a and b)/d(parameters of the normal equations).
Eigen::VectorXd baseline_gradient(const BundleProblem& problem, const std::vector<Camera>& cameras, int a,
                                  int b, Eigen::Index columns);

struct CameraPair {
  int a = 0, b = 0;
};

struct Clustered {
  Eigen::MatrixXd covariance;            // of NormalEquations::order; its rank is that of the frames
  Eigen::VectorXd sigma;                 // of each parameter
  std::vector<double> baseline_sigma_m;  // of each pair
};
// Below 20 frames by jackknife, else by sandwich. numeric error when a solve without a frame fails.
Clustered clustered_by_frame(const BundleProblem& problem, const BundleState& solution,
                             const NormalEquations& equations, const Eigen::MatrixXd& cofactors,
                             const std::vector<CameraPair>& pairs);

// The solution over a subset of the frames, started from the whole set's. numeric error when it does not
// converge.
BundleState solve_subset(const BundleProblem& problem, const BundleState& start,
                         const std::vector<bool>& keep_frame);

}  // namespace bpms
