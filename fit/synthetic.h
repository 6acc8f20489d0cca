// Leaves with known functions, measured without or with noise of known covariance: truth for tests and
// examples. The midrib comes from plant/leaf_frame.h, not from the fit's own forward model.
#pragma once
#include <Eigen/Core>

#include "core/random.h"
#include "fit/measured_organ.h"
#include "plant/plant.h"

namespace bpms {

struct SyntheticLeaf {
  OrganAttributes organ;  // length, width and functions
  double direction = 0;   // about the vertical, radians from x towards y
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();
  int midrib_points = 15;
  int edge_points = 0;  // a side
};

struct SyntheticNoise {
  double sigma_m = 0;      // across the line of sight; 0: exact points, stated to be good to `stated_m`
  double depth_ratio = 3;  // sigma along the line of sight over that across: what two cameras see
  double stated_m = 1e-5;
  double stated_ratio = 1;  // covariance stated = this squared times the true one (a lie, to test the tests)
};

// Points at uneven places; the first and the last of the midrib at l = 0 and 1.
MeasuredOrgan measure(const SyntheticLeaf& leaf, const SyntheticNoise& noise, Philox& random);

}  // namespace bpms
