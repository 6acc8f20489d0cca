// Inner corners of a ChArUco board: a chessboard with a marker in each white square. The markers say which
// corner is which and about where it is; its place is then refined on the image as that of any chessboard
// corner, so that neither lens distortion between the markers nor the convention of their corners enters.
#pragma once
#include "calibrate/targets/target_kind.h"

namespace bpms {

// Upper left corner and id of the marker in the square, in the board's frame; -1 where the square is black.
int charuco_marker_id(const Target& target, int row, int column);
Eigen::Vector2d charuco_marker_corner(const Target& target, int row, int column);

Detection find_charuco(const cv::Mat& grey, const Target& target);

}  // namespace bpms
