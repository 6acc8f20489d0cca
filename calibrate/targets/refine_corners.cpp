#include "calibrate/targets/refine_corners.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace bpms {

void refine_corners(const cv::Mat& grey, double free_px, std::vector<cv::Point2f>& corners) {
  if (corners.empty()) return;
  constexpr double of_free = 0.4;
  constexpr int widest = 5, narrowest = 2;
  const int half = std::clamp(static_cast<int>(of_free * free_px), narrowest, widest);
  constexpr int steps = 100;
  constexpr double enough_px = 1e-4;
  cv::cornerSubPix(grey, corners, cv::Size(half, half), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, steps, enough_px));
}

}  // namespace bpms
