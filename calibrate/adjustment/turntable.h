// Targets that turn on a table before cameras that stand: the axis from the poses that a target was found in,
// as a start for the adjustment in which the table is one pose and its angles are known.
#pragma once
#include "calibrate/adjustment/initial_estimate.h"

namespace bpms {

// `held`: the state of the same problem with the table left out and every target held anew in each frame
// (standing()). numeric error when the frames do not turn enough to tell an axis.
BundleState on_turntable(const BundleProblem& problem, const BundleProblem& standing,
                         const BundleState& held);
BundleProblem standing(const BundleProblem& problem);

// A first guess of any problem, with a turntable or without; see initial_estimate().
BundleState first_state(BundleProblem& problem, const std::vector<Observations::ObservedCamera>& cameras,
                        const LensChoice& lens);

// Of an adjusted table, in the rig's frame.
struct TurntableAxis {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // unit; the table turns about it right-handed
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();    // the one nearest to the rig's origin
};
TurntableAxis turntable_axis(const Pose& rig_from_table);
// d(direction, point)/d(small left turn of the pose, its shift): 6x6.
Eigen::Matrix<double, 6, 6> axis_derivatives(const Pose& rig_from_table);

}  // namespace bpms
