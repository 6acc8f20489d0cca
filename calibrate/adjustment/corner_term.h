// The term of one corner: projected minus measured, in pixels, through the chain lens, camera, rig, target.
#pragma once
#include <ceres/cost_function.h>

#include <memory>

#include "calibrate/adjustment/network.h"

namespace bpms {

// Blocks in this order, those that are not estimated left out: lens, camera pose, rig pose, target pose,
// bending, point. What is not estimated stays as it is in `state`.
struct CornerBlocks {
  bool lens = false, camera = false, rig = false, target = false, bending = false, point = false;
};
std::unique_ptr<ceres::CostFunction> corner_term(const BundleProblem& problem, const BundleState& state,
                                                 const CornerObservation& corner, const CornerBlocks& blocks);

}  // namespace bpms
