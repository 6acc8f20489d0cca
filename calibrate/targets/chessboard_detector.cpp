#include "calibrate/targets/chessboard_detector.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "calibrate/targets/refine_corners.h"

namespace bpms {
namespace {

// Between neighbours along rows and columns, in pixels.
double smallest_spacing(const std::vector<cv::Point2f>& corners, const Target& target) {
  double least = HUGE_VAL;
  for (int row = 0; row < target.rows; ++row) {
    for (int column = 0; column < target.columns; ++column) {
      const auto at = static_cast<std::size_t>(row * target.columns + column);
      if (column > 0) least = std::min(least, cv::norm(corners[at] - corners[at - 1]));
      if (row > 0)
        least =
            std::min(least, cv::norm(corners[at] - corners[at - static_cast<std::size_t>(target.columns)]));
    }
  }
  return least;
}

bool find_board(const cv::Mat& grey, const Target& target, std::vector<cv::Point2f>& corners) {
  const cv::Size size(target.columns, target.rows);
  if (cv::findChessboardCorners(grey, size, corners,
                                cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE))
    return true;
  return cv::findChessboardCornersSB(grey, size, corners, cv::CALIB_CB_NORMALIZE_IMAGE);
}

// Sum over the squares between the corners of their grey value, squares of one colour counted negative.
double chequer_contrast(const cv::Mat& grey, const std::vector<cv::Point2f>& corners, const Target& target) {
  double sum = 0;
  for (int row = 0; row + 1 < target.rows; ++row) {
    for (int column = 0; column + 1 < target.columns; ++column) {
      const auto at = static_cast<std::size_t>(row * target.columns + column),
                 next = at + static_cast<std::size_t>(target.columns);
      const cv::Point2f centre = 0.25F * (corners[at] + corners[at + 1] + corners[next] + corners[next + 1]);
      const int x = std::clamp(cvRound(centre.x), 0, grey.cols - 1),
                y = std::clamp(cvRound(centre.y), 0, grey.rows - 1);
      sum += ((row + column) % 2 == 0 ? 1 : -1) * static_cast<double>(grey.at<unsigned char>(y, x));
    }
  }
  return sum;
}

// Rows and columns must turn as x right, y down; the first square is the dark one where the colours can tell.
void put_in_order(const cv::Mat& grey, const Target& target, std::vector<cv::Point2f>& corners) {
  const cv::Point2f along = corners[static_cast<std::size_t>(target.columns - 1)] - corners.front();
  const cv::Point2f down =
      corners[static_cast<std::size_t>(target.columns * (target.rows - 1))] - corners.front();
  if (along.cross(down) < 0) {
    for (int row = 0; row < target.rows; ++row) {
      const auto begin = corners.begin() + row * target.columns;
      std::reverse(begin, begin + target.columns);
    }
  }
  const bool colours_tell = (target.columns + target.rows) % 2 != 0;
  if (colours_tell && chequer_contrast(grey, corners, target) > 0)
    std::reverse(corners.begin(), corners.end());
}

}  // namespace

std::optional<std::vector<Eigen::Vector2d>> find_chessboard(const cv::Mat& grey, const Target& target) {
  std::vector<cv::Point2f> corners;
  if (!find_board(grey, target, corners) || static_cast<int>(corners.size()) != target.size())
    return std::nullopt;
  refine_corners(grey, smallest_spacing(corners, target), corners);
  put_in_order(grey, target, corners);
  std::vector<Eigen::Vector2d> out;
  for (const cv::Point2f& corner : corners) out.emplace_back(corner.x, corner.y);
  return out;
}

}  // namespace bpms
