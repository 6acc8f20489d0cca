// Terms of what is known beforehand: surveyed points, scale bars, the datum of free points, beliefs of a
// lens model. In pixels: a
// deviation of one sigma counts as sigma_px.
#pragma once
#include <ceres/cost_function.h>

#include <memory>
#include <vector>

#include "calibrate/adjustment/network.h"
#include "calibrate/lenses/lens.h"

namespace bpms {

// Block: the point's shift. L^-1 shift with L L' its covariance.
std::unique_ptr<ceres::CostFunction> surveyed_point_term(const Eigen::Matrix3d& covariance_m2,
                                                         double sigma_px);
// Blocks: the shifts of both points.
std::unique_ptr<ceres::CostFunction> scale_bar_term(const ScaleBar& bar, const Eigen::Vector3d& a_m,
                                                    const Eigen::Vector3d& b_m, double sigma_px);
// Blocks: the shifts of all points. Their sum, their moment about the centre and, `with_size`, their growth
// from the centre are zero.
std::unique_ptr<ceres::CostFunction> inner_constraints(const std::vector<Eigen::Vector3d>& points_m,
                                                       bool with_size, double sigma_px);

// Block: the lens.
std::unique_ptr<ceres::CostFunction> lens_prior_term(std::vector<LensPrior> priors, std::size_t parameters,
                                                     double sigma_px);

}  // namespace bpms
