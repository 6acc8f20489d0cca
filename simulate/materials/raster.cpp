#include "simulate/materials/raster.h"

#include <algorithm>
#include <cmath>

namespace bpms {
namespace {

// Pixels are squares: pixel i of n covers [i/n, (i+1)/n).
std::size_t wrapped_pixel(float position, std::size_t count) {
  const float part = position - std::floor(position);
  return std::min(static_cast<std::size_t>(part * static_cast<float>(count)), count - 1);
}

struct PixelPair {
  std::size_t low, high;
  float t;
};

PixelPair pair_around(float position, std::size_t count) {
  const float part = position - std::floor(position);
  float at = part * static_cast<float>(count) - 0.5f;
  if (at < 0) at += static_cast<float>(count);
  const std::size_t low = std::min(static_cast<std::size_t>(at), count - 1);
  return {low, (low + 1) % count, std::min(at - static_cast<float>(low), 1.0f)};
}

}  // namespace

float Raster::nearest(const Eigen::Vector2f& uv) const {
  return at(wrapped_pixel(uv.x(), columns_), rows_ - 1 - wrapped_pixel(uv.y(), rows_));
}

Raster::Sloped Raster::bilinear(const Eigen::Vector2f& uv) const {
  const PixelPair u = pair_around(uv.x(), columns_), v = pair_around(uv.y(), rows_);
  const std::size_t low_row = rows_ - 1 - v.low, high_row = rows_ - 1 - v.high;
  const float low_left = at(u.low, low_row), low_right = at(u.high, low_row);
  const float high_left = at(u.low, high_row), high_right = at(u.high, high_row);
  const float low = low_left + u.t * (low_right - low_left);
  const float high = high_left + u.t * (high_right - high_left);
  const float across = (1 - v.t) * (low_right - low_left) + v.t * (high_right - high_left);
  return {low + v.t * (high - low), across * static_cast<float>(columns_),
          (high - low) * static_cast<float>(rows_)};
}

}  // namespace bpms
