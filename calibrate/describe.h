// What a solved network says, in the words of its users.
#pragma once
#include "calibrate/adjustment/network.h"
#include "calibrate/adjustment/normal_equations.h"
#include "calibrate/adjustment/outliers.h"
#include "calibrate/calibrate.h"

namespace bpms {

void describe_views(const Observations& observations, const BundleProblem& problem, const BundleState& state,
                    const OutlierSearch& search, Calibration& out);
void describe_targets(const Observations& observations, const BundleProblem& problem,
                      const BundleState& state, Calibration& out);
// The clustered covariance has the rank of the frames, often fewer than the parameters: the file gets the iid
// correlations with the clustered sigmas, which is positive definite and honest on the diagonal.
Rig::Covariance rig_covariance(const NormalEquations& equations, const Eigen::MatrixXd& cofactors,
                               const Eigen::VectorXd& sigma_iid, const Eigen::VectorXd& sigma,
                               const std::string& kind);
// The usual distance of the corners from each camera; 0 where it saw none.
std::vector<double> usual_ranges(const BundleProblem& problem, const BundleState& state);

}  // namespace bpms
