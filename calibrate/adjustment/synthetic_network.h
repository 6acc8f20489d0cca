// Networks whose truth is known: a rig that stands before boards, or that is carried around a control frame
// (tags on three walls of a box), with what of it is in the images. See synthetic.h for the plain case.
#pragma once
#include <cstdint>

#include "calibrate/adjustment/network.h"
#include "calibrate/observations.h"

namespace bpms {

struct SyntheticNetworkOptions {
  int cameras = 2;
  int frames = 20;
  bool rig_moves = false;
  int held_boards = 1;                     // 9x6 corners of 25 mm, in every frame anew
  bool control_frame = false;              // 0.6 m wide, 48 points, stands
  PointsKnown known = PointsKnown::exact;  // of the control frame's points
  double survey_sigma_m = 1e-4;            // of each coordinate of a surveyed point; of a scale bar
  double table_step_rad = 0;               // not 0: the first board stands on a turntable before the cameras
  int scale_bars = 0;                      // between corners of the control frame
  std::string lens = "brown4";
  std::uint64_t seed = 1;
};
struct SyntheticNetwork {
  BundleProblem problem;  // with the corners that fall into the images, without noise
  BundleState truth;
  std::vector<Observations::ObservedCamera> cameras() const;
};
SyntheticNetwork synthetic_network(const SyntheticNetworkOptions& options);

// What was measured of it: pixels with normal errors of `sigma_px` each axis, scale bars and surveyed points
// with errors of their sigmas; the shape of a free frame is known to 2 mm. Without noise in the pixels there
// is none in bars and surveys.
struct NetworkMeasurement {
  BundleProblem problem;
  BundleState truth;                  // shifts of the points are from the nominal coordinates as measured
  Observations observations() const;  // as if from images "cameraA0001"
};
NetworkMeasurement measured(const SyntheticNetwork& network, double sigma_px, std::uint64_t seed);

}  // namespace bpms
