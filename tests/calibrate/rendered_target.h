// Photographs of any printed target whose points are known exactly: a pinhole without distortion, so straight
// edges stay straight. Each cell of a grid four times as fine as the pixels gets the exact share of black in
// it (polygons clipped to the cell), then the blur of the lens (a Gaussian), then the pixel (a mean of its
// cells), then noise.
#pragma once
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "calibrate/targets/drawing.h"
#include "core/random.h"
#include "core/units.h"

namespace bpms::test {

struct TargetView {
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();  // camera from board
  Eigen::Vector3d t_m = Eigen::Vector3d(0, 0, 1);
  double focal_px = 700;
  int width_px = 640, height_px = 480;
  double blur_px = 0.7, noise = 0;
  double black = 30, white = 230;
  Eigen::Vector2d centre_px() const { return {width_px / 2.0 + 0.3, height_px / 2.0 - 0.4}; }
  Eigen::Vector2d pixel(const Eigen::Vector3d& x) const {
    return focal_px * (r * x + t_m).hnormalized() + centre_px();
  }
};

// The middle of the drawing in the middle of the image, so far away that it fills `share` of it.
inline TargetView view_of(const Drawing& drawing, double roll_deg, double tilt_deg, double towards_deg,
                          double share = 0.8) {
  TargetView out;
  const Eigen::Vector3d axis(std::cos(radians(towards_deg)), std::sin(radians(towards_deg)), 0);
  out.r = (Eigen::AngleAxisd(radians(tilt_deg), axis) *
           Eigen::AngleAxisd(radians(roll_deg), Eigen::Vector3d::UnitZ()))
              .toRotationMatrix();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  middle.head<2>() = (drawing.quiet_low + drawing.quiet_high) / 2;
  const Eigen::Vector2d size = drawing.quiet_high - drawing.quiet_low;
  // Nearer and nearer until a corner leaves the image.
  for (double z = 20 * size.norm();; z *= 0.98) {
    const TargetView before = out;
    out.t_m = Eigen::Vector3d(0, 0, z) - out.r * middle;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d corner(middle.x() + (i % 2 ? 0.5 : -0.5) * size.x(),
                                   middle.y() + (i / 2 ? 0.5 : -0.5) * size.y(), 0);
      const Eigen::Vector2d off = (out.pixel(corner) - out.centre_px()).cwiseAbs();
      if (off.x() > share * out.width_px / 2 || off.y() > share * out.height_px / 2) return before;
    }
  }
}

namespace render {

using Polygon = std::vector<Eigen::Vector2d>;

// The part on one side of x[axis] = at.
inline Polygon clip(const Polygon& in, int axis, double at, double sign) {
  Polygon out;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Eigen::Vector2d &a = in[i], &b = in[(i + 1) % in.size()];
    const double da = sign * (a[axis] - at), db = sign * (b[axis] - at);
    if (da >= 0) out.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) out.push_back(a + (b - a) * (da / (da - db)));
  }
  return out;
}

inline double area(const Polygon& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Eigen::Vector2d &a = p[i], &b = p[(i + 1) % p.size()];
    sum += a.x() * b.y() - b.x() * a.y();
  }
  return std::abs(sum) / 2;
}

// Adds the polygon's share of each cell; cell (u, v) fills u - 1/2 .. u + 1/2.
inline void fill(const Polygon& polygon, cv::Mat& share) {
  if (polygon.empty()) return;
  Eigen::Vector2d low = polygon.front(), high = low;
  for (const auto& p : polygon) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const int first = std::max(0, static_cast<int>(std::floor(low.y() + 0.5))),
            last = std::min(share.rows - 1, static_cast<int>(std::floor(high.y() + 0.5)));
  for (int v = first; v <= last; ++v) {
    const Polygon strip = clip(clip(polygon, 1, v - 0.5, 1), 1, v + 0.5, -1);
    if (strip.size() < 3) continue;
    double left = strip.front().x(), right = left;
    for (const auto& p : strip) left = std::min(left, p.x()), right = std::max(right, p.x());
    const int begin = std::max(0, static_cast<int>(std::floor(left + 0.5))),
              end = std::min(share.cols - 1, static_cast<int>(std::floor(right + 0.5)));
    for (int u = begin; u <= end; ++u)
      share.at<float>(v, u) += static_cast<float>(area(clip(clip(strip, 0, u - 0.5, 1), 0, u + 0.5, -1)));
  }
}

}  // namespace render

// 8-bit; the whole image is paper.
inline cv::Mat render_drawing(const Drawing& drawing, const TargetView& view, std::uint64_t seed = 1) {
  constexpr int fine = 4;  // cells along a pixel
  cv::Mat share(fine * view.height_px, fine * view.width_px, CV_32F, cv::Scalar(0));
  const auto cell = [&](double x, double y) -> Eigen::Vector2d {
    const Eigen::Vector2d pixel = view.pixel({x, y, 0});
    return fine * (pixel + Eigen::Vector2d(0.5, 0.5)) - Eigen::Vector2d(0.5, 0.5);
  };
  for (const auto& [x, y, w, h] : drawing.black)
    render::fill({cell(x, y), cell(x + w, y), cell(x + w, y + h), cell(x, y + h)}, share);
  for (const Drawing::Disc& disc : drawing.discs) {
    constexpr int sides = 200;  // of equal area: 2e-4 of the radius out of round
    const double r = disc.radius * std::sqrt(2 * pi / sides / std::sin(2 * pi / sides));
    render::Polygon round;
    for (int i = 0; i < sides; ++i)
      round.push_back(
          cell(disc.x + r * std::cos(2 * pi * i / sides), disc.y + r * std::sin(2 * pi * i / sides)));
    render::fill(round, share);
  }
  cv::Mat blurred, pixels;
  cv::GaussianBlur(share, blurred, cv::Size(), fine * view.blur_px, fine * view.blur_px,
                   cv::BORDER_REPLICATE);
  cv::resize(blurred, pixels, cv::Size(view.width_px, view.height_px), 0, 0, cv::INTER_AREA);
  Philox random(seed, 7);
  cv::Mat out(view.height_px, view.width_px, CV_8U);
  for (int v = 0; v < out.rows; ++v) {
    for (int u = 0; u < out.cols; ++u) {
      const double grey = view.white +
                          (view.black - view.white) * static_cast<double>(pixels.at<float>(v, u)) +
                          (view.noise > 0 ? view.noise * random.normal() : 0);
      out.at<unsigned char>(v, u) = cv::saturate_cast<unsigned char>(grey);
    }
  }
  return out;
}

}  // namespace bpms::test
