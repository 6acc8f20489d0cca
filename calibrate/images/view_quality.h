// How sharp and how well exposed a target is in an image.
#pragma once
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "calibrate/observations.h"

namespace bpms {

struct ViewQuality {
  // Standard deviation of the Gaussian that edges are blurred by, the median over the points: from the
  // contrast c around a point and the steepest gradient g, a step blurred by s has g = c / (s sqrt(2 pi)).
  // What pixels and the difference of neighbours add to s is taken off.
  double blur_px = 0;
  double overexposed = 0;  // share of the target's area at the top of the scale
  double contrast = 0;     // grey values, the median over the points
};

ViewQuality view_quality(const cv::Mat& grey, const std::vector<ImageCorner>& corners);
// In words, where it is bad enough to tell.
std::vector<std::string> quality_remarks(const ViewQuality& quality);

}  // namespace bpms
