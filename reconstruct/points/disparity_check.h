// A check against a dense disparity map measured by other means (Middlebury's structured light, say): the
// depth of each point in the left camera against Z = f B / (d + D), with d the map's value at the point's
// left pixel, f the focal length, B the baseline and D = cx_right - cx_left of a rectified pair. A pixel with
// d = 0 is unknown. The ratio |dZ|/sigma_Z takes the points' own sigma; the map's rounding to whole pixels
// (0.29 px rms) is not in it. For normal errors its median is 0.67.
#pragma once
#include <string>
#include <vector>

#include "reconstruct/reconstruct.h"

namespace bpms {

struct DisparityCheck {
  struct Point {
    std::string label;
    double dz_m;
    double sigma_m;
    double ratio;  // |dz| / sigma
    bool rejected;
  };
  std::vector<Point> points;  // those with an estimate, where the map is known
  int unknown = 0;            // points where the map is 0
  double median_ratio = 0;    // over the accepted points
  double median_abs_dz_m = 0;
};

// The rig must hold a rectified pair (no distortion, same focal lengths, rotation and cy, baseline along x).
DisparityCheck check_disparity(const std::string& map_path, const Vectors& vectors, const Rig& rig);

}  // namespace bpms
