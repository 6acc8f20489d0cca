// The joint adjustment of a network to the corners seen: least squares of the pixel residuals, or with a
// Cauchy loss where outliers are still to be found.
#pragma once
#include "calibrate/adjustment/network.h"

namespace bpms {

struct AdjustOptions {
  double cauchy_px = 0;      // scale of the loss; 0 = plain least squares
  double tolerance = 1e-14;  // relative change of the cost at which the last step counts as converged
  int most_iterations = 500;
};
struct AdjustResult {
  bool converged = false;
  int iterations = 0;
};
// Moves `state` to the minimum over the used corners. The state must project every one of them.
AdjustResult adjust(const BundleProblem& problem, const AdjustOptions& options, BundleState& state);

}  // namespace bpms
