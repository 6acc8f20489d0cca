// Gross errors among digitised points: found by a robust fit of a rich function, before functions are chosen,
// so that a poor function's misfit is never taken for a bad point and a bad point never buys coefficients.
#pragma once
#include <vector>

#include "fit/curve_solver.h"
#include "fit/fit.h"

namespace bpms {

// Those of the observations with a free place that lie farther than five sigma from the robust fit (of the
// stated errors, or of the robust scatter where that is larger), found by Cauchy weights from `start` on with
// the first `held` parameters kept. None when more than a fifth would go: then the function is wrong, or the
// errors are.
std::vector<std::size_t> far_observations(LeafModel& model, std::vector<LeafObservation> observations,
                                          const Eigen::VectorXd& start, int held);

// Removes such points from the midrib and returns their numbers. The ends stay: they are the base and the
// tip. Organs without stated errors, or with fewer than ten points, keep all.
std::vector<int> remove_outliers(MeasuredOrgan& organ, const FitOptions& options);

}  // namespace bpms
