// The term of what a lens model says of its parameters before any image. In pixels: a deviation of one sigma
// counts as sigma_px.
#pragma once
#include <ceres/cost_function.h>

#include <memory>
#include <vector>

#include "calibrate/lenses/lens.h"

namespace bpms {

// Block: the lens, of `count` parameters.
std::unique_ptr<ceres::CostFunction> lens_prior_term(std::vector<LensPrior> priors, std::size_t count,
                                                     double sigma_px);

}  // namespace bpms
