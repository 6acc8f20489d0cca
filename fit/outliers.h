// Gross errors among digitised points: found by a robust fit of a rich function, before functions are chosen,
// so that a poor function's misfit is never taken for a bad point and a bad point never buys coefficients.
#pragma once
#include <vector>

#include "fit/fit.h"

namespace bpms {

// Removes midrib points farther from the robust fit than five sigma (of the stated errors, or of the robust
// scatter where that is larger) and returns their numbers. The ends stay: they are the base and the tip.
// Organs without stated errors, or with fewer than ten points, keep all.
std::vector<int> remove_outliers(MeasuredOrgan& organ, const FitOptions& options);

}  // namespace bpms
