// Chessboard corners in photographs, to a few hundredths of a pixel on a good board.
// OpenCV finds the board; cornerSubPix refines in a window fitted to the squares in the image: with the
// customary 11 pixels it reaches into neighbouring corners of a small board and returns errors of several
// pixels.
#pragma once
#include <optional>
#include <vector>

#include "calibrate/targets/target.h"

namespace cv {
class Mat;
}

namespace bpms {

// All corners in the order of Target::points_m(), of an 8-bit grey image; nullopt when the board is not found
// whole. Where columns + rows is odd the colours tell which end is which; otherwise the order may be turned
// by 180 degrees.
std::optional<std::vector<Eigen::Vector2d>> find_chessboard(const cv::Mat& grey, const Target& target);

}  // namespace bpms
