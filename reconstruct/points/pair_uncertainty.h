// How sure two cameras of a rig place a point that both see, before any point is digitised: on the axis that
// the two share, from the middle between their centres along the bisector of their optical axes. Directions:
// z along that axis, x along the baseline as seen from there, y across both. The observation part takes one
// pixel error of `sigma_px` per axis in each image; the total adds the rig's covariance, in the rig's frame.
// Of a rectified pair with focal length f (px) and baseline B: sigma_z = sqrt(2) z^2 sigma / (f B),
// sigma_x = sigma_y = z sigma / (sqrt(2) f) (observation part).
#pragma once
#include <Eigen/Core>
#include <vector>

#include "calibrate/rig.h"

namespace bpms {

struct PairUncertainty {
  double range_m = 0;                                             // from the middle between the centres
  Eigen::Vector3d observation_sigma_m = Eigen::Vector3d::Zero();  // x, y, z
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Zero();              // with the rig's covariance
};

// Of the ranges at which both images hold the point; none where the cameras look at each other or have one
// centre.
std::vector<PairUncertainty> pair_uncertainty(const Rig& rig, int a, int b, double sigma_px,
                                              const std::vector<double>& ranges_m);

}  // namespace bpms
