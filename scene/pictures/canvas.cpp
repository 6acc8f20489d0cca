#include "scene/pictures/canvas.h"

#include <algorithm>
#include <cmath>

namespace bpms {
namespace {

// How much of [cell, cell + 1) lies in [low, high].
double share(int cell, double low, double high) {
  return std::clamp(std::min(high, cell + 1.0) - std::max(low, static_cast<double>(cell)), 0.0, 1.0);
}

double distance_to(const Stroke& stroke, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = stroke.to - stroke.from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp(along.dot(point - stroke.from) / length2, 0.0, 1.0) : 0;
  return (point - stroke.from - t * along).norm();
}

}  // namespace

Canvas::Canvas(int width, int height) : width_(width), height_(height) {
  colour_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, 0.f);
}

void Canvas::over(int x, int y, const Rgb& colour, double opacity) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_ || !(opacity > 0)) return;
  float* p = &colour_[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                           static_cast<std::size_t>(x))];
  const auto a = static_cast<float>(std::min(1.0, opacity));
  for (std::size_t k = 0; k < 3; ++k) p[k] = a * static_cast<float>(colour[k]) + (1 - a) * p[k];
  p[3] = a + (1 - a) * p[3];
}

void Canvas::fill(const Rgb& colour) {
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) over(x, y, colour, 1);
}

void Canvas::rectangle(double left, double top, double right, double bottom, const Rgb& colour) {
  for (int y = static_cast<int>(std::floor(top)); y < bottom; ++y)
    for (int x = static_cast<int>(std::floor(left)); x < right; ++x)
      over(x, y, colour, share(x, left, right) * share(y, top, bottom));
}

void Canvas::strokes(const std::vector<Stroke>& strokes, double pen, const Rgb& colour) {
  if (strokes.empty()) return;
  Eigen::Vector2d low = strokes[0].from, high = low;
  for (const Stroke& stroke : strokes) {
    low = low.cwiseMin(stroke.from).cwiseMin(stroke.to);
    high = high.cwiseMax(stroke.from).cwiseMax(stroke.to);
  }
  const double reach = 0.5 * pen + 1;
  // Strokes that touch are laid on once: what counts is the nearest.
  for (int y = static_cast<int>(std::floor(low.y() - reach)); y < high.y() + reach; ++y) {
    for (int x = static_cast<int>(std::floor(low.x() - reach)); x < high.x() + reach; ++x) {
      const Eigen::Vector2d middle(x + 0.5, y + 0.5);
      double nearest = reach;
      for (const Stroke& stroke : strokes) {
        if (std::min(stroke.from.x(), stroke.to.x()) > middle.x() + reach ||
            std::max(stroke.from.x(), stroke.to.x()) < middle.x() - reach)
          continue;
        nearest = std::min(nearest, distance_to(stroke, middle));
      }
      over(x, y, colour, std::clamp(0.5 * pen + 0.5 - nearest, 0.0, 1.0));
    }
  }
}

void Canvas::text(std::string_view utf8, const Eigen::Vector2d& base_left, double cap_height,
                  const Rgb& colour) {
  constexpr double pen_of_cap = 0.14;
  strokes(text_strokes(utf8, base_left, cap_height), std::max(1.0, pen_of_cap * cap_height), colour);
}

RgbImage Canvas::image() const {
  RgbImage out{width_, height_, {}, {}};
  const std::size_t pixels = colour_.size() / 4;
  out.rgb.resize(3 * pixels);
  out.alpha.resize(pixels);
  bool opaque = true;
  for (std::size_t i = 0; i < pixels; ++i) {
    const float a = colour_[4 * i + 3];
    for (std::size_t k = 0; k < 3; ++k)
      out.rgb[3 * i + k] =
          a > 0 ? static_cast<std::uint8_t>(std::lround(std::clamp(colour_[4 * i + k] / a, 0.f, 255.f))) : 0;
    out.alpha[i] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(a, 0.f, 1.f)));
    opaque &= out.alpha[i] == 255;
  }
  if (opaque) out.alpha.clear();
  return out;
}

}  // namespace bpms
