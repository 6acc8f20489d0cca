// Saddle points of a black and white pattern, refined on the image: the point at which all gradients in a
// window are at right angles to the line from it (Förstner; OpenCV's cornerSubPix).
#pragma once
#include <opencv2/core.hpp>
#include <vector>

namespace bpms {

// The window reaches 0.4 of the distance to the nearest other edge, at most 5 pixels and at least 2: wider
// ones take in the neighbours of small boards and return errors of several pixels.
void refine_corners(const cv::Mat& grey, double free_px, std::vector<cv::Point2f>& corners);

}  // namespace bpms
