#include "calibrate/valid_region.h"

#include <algorithm>
#include <iterator>

namespace bpms {
namespace {

// Twice the area of the triangle, positive when it turns left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d u = b - a, v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

}  // namespace

// Andrew 1979: the lower chain from the left, the upper one from the right.
std::vector<Eigen::Vector2d> hull_of_pixels(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> out;
  const auto chain = [&out](auto first, auto last) {
    const std::size_t base = out.size();
    for (auto at = first; at != last; ++at) {
      while (out.size() >= base + 2 && turn(out[out.size() - 2], out.back(), *at) <= 0) out.pop_back();
      out.push_back(*at);
    }
    out.pop_back();  // the other chain begins with it
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return out;
}

bool inside_hull(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& point) {
  if (hull.size() < 3) return false;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (turn(hull[i], hull[(i + 1) % hull.size()], point) < 0) return false;
  }
  return true;
}

std::vector<Eigen::Vector2d> valid_region(const Observations& observations, int camera) {
  std::vector<Eigen::Vector2d> points;
  for (const BoardView& view : observations.views) {
    if (view.camera != camera) continue;
    for (const ImageCorner& corner : view.corners) points.push_back(corner.pixel);
  }
  return hull_of_pixels(std::move(points));
}

}  // namespace bpms
