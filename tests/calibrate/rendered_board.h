// Photographs of a chessboard whose corners are known exactly: a pinhole of 500 px, 640x480 pixels.
#pragma once
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "calibrate/targets/target.h"
#include "core/units.h"

namespace bpms::test {

constexpr double focal_px = 500;
constexpr int board_image_width = 640, board_image_height = 480;

struct BoardPose {
  Eigen::Matrix3d r;
  Eigen::Vector3d t_m;
};
inline BoardPose look_at(const Target& target, double roll_deg, double tilt_deg) {
  const Eigen::Matrix3d r = (Eigen::AngleAxisd(radians(tilt_deg), Eigen::Vector3d(1, 0.4, 0).normalized()) *
                             Eigen::AngleAxisd(radians(roll_deg), Eigen::Vector3d::UnitZ()))
                                .toRotationMatrix();
  const Eigen::Vector3d middle((target.columns - 1) * target.square_m / 2,
                               (target.rows - 1) * target.square_m / 2, 0);
  return {r, Eigen::Vector3d(0.011, -0.007, 0.42) - r * middle};
}
inline Eigen::Vector2d pixel(const BoardPose& view, const Eigen::Vector3d& x) {
  const Eigen::Vector3d c = view.r * x + view.t_m;
  return focal_px * c.head<2>() / c.z() + Eigen::Vector2d(320.3, 239.6);
}

// Pixel centres are integers: the samples of a pixel fill -1/2 .. 1/2 about it, on a lattice that has as many
// steps along each axis as it has points.
inline cv::Mat render(const Target& target, const BoardPose& view) {
  Eigen::Matrix3d k, plane;
  k << focal_px, 0, 320.3, 0, focal_px, 239.6, 0, 0, 1;
  plane << view.r.col(0), view.r.col(1), view.t_m;
  const Eigen::Matrix3d from_image = (k * plane).inverse();
  constexpr int samples = 34, stride = 21;  // Fibonacci lattice
  cv::Mat image(board_image_height, board_image_width, CV_32F);
  for (int v = 0; v < board_image_height; ++v) {
    for (int u = 0; u < board_image_width; ++u) {
      double sum = 0;
      for (int i = 0; i < samples; ++i) {
        const Eigen::Vector3d q(u + (i + 0.5) / samples - 0.5,
                                v + (i * stride % samples + 0.5) / samples - 0.5, 1);
        const Eigen::Vector2d x = (from_image * q).hnormalized() / target.square_m;
        const int column = static_cast<int>(std::floor(x.x())), row = static_cast<int>(std::floor(x.y()));
        const bool inside = column >= -1 && row >= -1 && column < target.columns && row < target.rows;
        sum += inside && (column + row) % 2 == 0 ? 30 : 220;
      }
      image.at<float>(v, u) = static_cast<float>(sum / samples);
    }
  }
  cv::Mat blurred, out;
  cv::GaussianBlur(image, blurred, cv::Size(7, 7), 0.7);
  blurred.convertTo(out, CV_8U);
  return out;
}

}  // namespace bpms::test
