#include "calibrate/images/overlay.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace bpms {
namespace {

constexpr int sub_pixel_bits = 4;  // OpenCV draws at fractions of a pixel in these units
cv::Point place(const Eigen::Vector2d& at) {
  constexpr double unit = 1 << sub_pixel_bits;
  return {cvRound(unit * at.x()), cvRound(unit * at.y())};
}

cv::Scalar colour_at(double share) {
  constexpr double violet = 140, full = 255;  // of OpenCV's 180 hues
  cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(violet * share, full, full));
  cv::cvtColor(pixel, pixel, cv::COLOR_HSV2BGR);
  const cv::Vec3b bgr = pixel.at<cv::Vec3b>(0, 0);
  return {static_cast<double>(bgr[0]), static_cast<double>(bgr[1]), static_cast<double>(bgr[2])};
}

void draw_found(const Target& target, const Detection& found, double size, cv::Mat& out) {
  const auto shift = sub_pixel_bits;
  const int thickness = std::max(1, cvRound(size / 6));
  for (std::size_t i = 0; i < found.corners.size(); ++i) {
    const auto& [point, at] = found.corners[i];
    const cv::Scalar colour = colour_at(static_cast<double>(i) / static_cast<double>(found.corners.size()));
    if (i > 0)
      cv::line(out, place(found.corners[i - 1].pixel), place(at), colour, thickness, cv::LINE_AA, shift);
    for (const Eigen::Vector2d& arm : {Eigen::Vector2d(size, size), Eigen::Vector2d(size, -size)})
      cv::line(out, place(at - arm), place(at + arm), colour, thickness, cv::LINE_AA, shift);
  }
  for (const auto& [point, at] : found.corners) {
    const std::string name = target.point_name(point);
    const cv::Point right(cvRound(at.x() + size), cvRound(at.y() - size / 2));
    const double scale = size / 14;
    for (const auto& [colour, width] :
         {std::pair(cv::Scalar(0, 0, 0), 2 * thickness + 1), std::pair(cv::Scalar(0, 255, 255), thickness)})
      cv::putText(out, name, right, cv::FONT_HERSHEY_SIMPLEX, scale, colour, width, cv::LINE_AA);
  }
}

}  // namespace

std::string overlay_png(const cv::Mat& grey, const std::vector<Target>& targets,
                        const std::vector<Detection>& found) {
  // Small images are doubled, so that marks leave something to see.
  constexpr int small = 1200;
  const int factor = std::max(1, static_cast<int>(std::ceil(static_cast<double>(small) / grey.cols)));
  cv::Mat large, out;
  cv::resize(grey, large, cv::Size(), factor, factor, cv::INTER_NEAREST);
  cv::cvtColor(large, out, cv::COLOR_GRAY2BGR);
  const double size = std::max(4.0, 0.004 * out.cols);
  for (std::size_t t = 0; t < found.size(); ++t) {
    Detection scaled = found[t];
    for (ImageCorner& corner : scaled.corners)
      corner.pixel = factor * (corner.pixel + Eigen::Vector2d(0.5, 0.5)) - Eigen::Vector2d(0.5, 0.5);
    draw_found(targets[t], scaled, size, out);
  }
  std::vector<unsigned char> bytes;
  cv::imencode(".png", out, bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace bpms
