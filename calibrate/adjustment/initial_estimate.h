// A first guess of cameras and poses from nothing but the corners: each camera is adjusted alone, then all
// are joined through what they saw together, by the relative poses that agree best with the others.
#pragma once
#include "calibrate/adjustment/network.h"
#include "calibrate/lenses/lens.h"
#include "calibrate/observations.h"

namespace bpms {

// Says of each corner whether it was placed. bad_input when a camera shares nothing with the others.
BundleState initial_estimate(BundleProblem& problem, const std::vector<Observations::ObservedCamera>& cameras,
                             const LensChoice& lens);

}  // namespace bpms
