// Calibrations whose truth is known: a rig, a board held before it, and the corners that its cameras would
// see, with normal noise. Estimators are judged by these: their errors must be what their covariance says.
#pragma once
#include <cstdint>

#include "calibrate/adjustment/network.h"
#include "calibrate/observations.h"
#include "calibrate/targets/target.h"

namespace bpms {

struct SyntheticCalibration {
  Target target;
  BundleState truth;              // cameras, board poses, bending
  BundleProblem problem() const;  // without corners
};

struct SyntheticOptions {
  int cameras = 2;  // side by side, 83 mm apart, slightly turned to each other; 640x480
  int frames = 13;  // the board 0.35 to 0.6 m away, tilted by up to 40 degrees, whole in every image
  std::string lens = "brown4";
  double focal_px = 535;
  Eigen::Vector2d bending_m{0.02e-3, -0.17e-3};
  std::uint64_t seed = 1;
};
SyntheticCalibration synthetic_calibration(const SyntheticOptions& options);

// Every corner in every camera and frame, named as "cameraA01"; `sigma_px` per axis.
Observations observe(const SyntheticCalibration& scene, double sigma_px, std::uint64_t seed);

}  // namespace bpms
