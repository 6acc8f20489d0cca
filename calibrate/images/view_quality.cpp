#include "calibrate/images/view_quality.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/units.h"

namespace bpms {
namespace {

double middle(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double spacing_at(const std::vector<ImageCorner>& corners, std::size_t i) {
  double nearest = HUGE_VAL;
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (k != i) nearest = std::min(nearest, (corners[k].pixel - corners[i].pixel).norm());
  return nearest;
}

struct Edge {
  double contrast = 0, blur_px = 0;
};
Edge edge_at(const cv::Mat& grey, const Eigen::Vector2d& at, int half) {
  std::vector<double> values;
  double steepest = 0;
  for (int y = cvRound(at.y()) - half; y <= cvRound(at.y()) + half; ++y) {
    for (int x = cvRound(at.x()) - half; x <= cvRound(at.x()) + half; ++x) {
      if (x < 1 || y < 1 || x + 1 >= grey.cols || y + 1 >= grey.rows) continue;
      const auto value = [&](int dx, int dy) {
        return static_cast<double>(grey.at<unsigned char>(y + dy, x + dx));
      };
      values.push_back(value(0, 0));
      steepest = std::max(steepest, std::hypot(value(1, 0) - value(-1, 0), value(0, 1) - value(0, -1)) / 2);
    }
  }
  if (values.size() < 9 || !(steepest > 0)) return {};
  constexpr double tail = 0.05;
  const auto rank = [&](double share) {
    const auto k =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), k, values.end());
    return *k;
  };
  Edge out;
  out.contrast = rank(1 - tail) - rank(tail);
  // A pixel is a box of width 1, a central difference one of width 2: variances 1/12 and 1/3.
  constexpr double of_sampling = 1.0 / 12 + 1.0 / 3;
  const double all = out.contrast / (steepest * std::sqrt(2 * pi));
  out.blur_px = std::sqrt(std::max(0.0, all * all - of_sampling));
  return out;
}

double overexposed_share(const cv::Mat& grey, const std::vector<ImageCorner>& corners) {
  std::vector<cv::Point> places, hull;
  for (const ImageCorner& corner : corners)
    places.emplace_back(cvRound(corner.pixel.x()), cvRound(corner.pixel.y()));
  cv::convexHull(places, hull);
  cv::Mat inside(grey.size(), CV_8U, cv::Scalar(0));
  cv::fillConvexPoly(inside, hull, cv::Scalar(255));
  constexpr int top = 254;
  const int all = cv::countNonZero(inside), bright = cv::countNonZero(inside & (grey >= top));
  return all > 0 ? static_cast<double>(bright) / all : 0;
}

}  // namespace

ViewQuality view_quality(const cv::Mat& grey, const std::vector<ImageCorner>& corners) {
  std::vector<double> blurs, contrasts;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    constexpr double of_spacing = 0.35;
    constexpr int narrowest = 4, widest = 12;
    const double reach = std::min<double>(widest, of_spacing * spacing_at(corners, i));
    const Edge edge = edge_at(grey, corners[i].pixel, std::max(narrowest, static_cast<int>(reach)));
    if (!(edge.contrast > 0)) continue;
    blurs.push_back(edge.blur_px);
    contrasts.push_back(edge.contrast);
  }
  ViewQuality out;
  out.blur_px = middle(blurs);
  out.contrast = middle(contrasts);
  out.overexposed = overexposed_share(grey, corners);
  return out;
}

std::vector<std::string> quality_remarks(const ViewQuality& quality) {
  constexpr double blurred_px = 2.5, faint = 40, mostly = 0.2;
  std::vector<std::string> out;
  if (quality.blur_px > blurred_px) out.push_back(fmt::format("blurred by {:.1f} px", quality.blur_px));
  if (quality.contrast < faint)
    out.push_back(fmt::format("contrast of only {:.0f} of 255 on the target", quality.contrast));
  if (quality.overexposed > mostly)
    out.push_back(fmt::format("overexposed on {:.0f} % of the target", 100 * quality.overexposed));
  return out;
}

}  // namespace bpms
