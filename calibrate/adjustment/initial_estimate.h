// A first guess of cameras and poses from nothing but the corners: homographies of the flat board give each
// camera's focal length (Zhang 2000, principal point at the centre) and the poses; each camera is then
// adjusted alone, and the cameras are joined through the frames that they share by the relative pose that
// agrees best with the others.
#pragma once
#include "calibrate/adjustment/bundle_adjustment.h"
#include "calibrate/lenses/lens.h"
#include "calibrate/observations.h"

namespace bpms {

// Throws when a camera shares no frame with the others.
BundleState initial_estimate(const BundleProblem& problem,
                             const std::vector<Observations::ObservedCamera>& cameras,
                             const LensChoice& lens);

}  // namespace bpms
