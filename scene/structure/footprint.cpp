#include "scene/structure/footprint.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// The plan view's hull of a prototype; of a disc, points on its rim.
std::vector<Eigen::Vector2d> hull(const Prototype& prototype) {
  constexpr int rim_points = 24;
  std::vector<Eigen::Vector2d> points;
  for (const Disc& disc : prototype.discs) {
    const Eigen::Vector3d n = disc.normal.cast<double>();
    const Eigen::Vector2d centre = disc.centre_m.cast<double>().head<2>();
    // The rim's shadow is an ellipse: radius across the tilt, radius * n_z along it.
    const double level = n.head<2>().norm();
    const Eigen::Vector2d along = level > 0 ? Eigen::Vector2d(n.head<2>() / level) : Eigen::Vector2d(1, 0);
    for (int k = 0; k < rim_points; ++k) {
      const double t = 2 * pi * k / rim_points;
      const Eigen::Vector2d across(-along.y(), along.x());
      points.push_back(centre +
                       disc.radius_m * (std::cos(t) * across + std::sin(t) * std::abs(n.z()) * along));
    }
    if (points.size() > 1'000'000) points = convex_hull(std::move(points));
  }
  if (prototype.mesh)
    for (const Eigen::Vector3f& p : prototype.mesh->positions_m) points.push_back(p.cast<double>().head<2>());
  return convex_hull(std::move(points));
}

}  // namespace

std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> out;
  const auto chain = [&](auto from, auto to) {
    const std::size_t base = out.size();
    for (auto p = from; p != to; ++p) {
      while (out.size() >= base + 2 && cross(out.back() - out[out.size() - 2], *p - out.back()) <= 0)
        out.pop_back();
      out.push_back(*p);
    }
    out.pop_back();  // it starts the other chain
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return out;
}

Footprint::Footprint(const Scene& scene) {
  is_domain_ = scene.domain.size_m.minCoeff() > 0;
  if (is_domain_) {
    const Eigen::Vector2d half = 0.5 * scene.domain.size_m;
    corners_ = {-half, {half.x(), -half.y()}, half, {-half.x(), half.y()}};
  } else {
    std::vector<std::vector<Eigen::Vector2d>> hulls;
    for (const Prototype& prototype : scene.prototypes) hulls.push_back(hull(prototype));
    std::vector<Eigen::Vector2d> all;
    for (const Instance& i : scene.instances) {
      const double c = std::cos(i.rotation), s = std::sin(i.rotation);
      for (const Eigen::Vector2d& p : hulls[i.prototype])
        all.push_back(i.position_m.head<2>() +
                      i.scale * Eigen::Vector2d(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
    }
    corners_ = convex_hull(std::move(all));
  }
  for (std::size_t k = 2; k < corners_.size(); ++k) {
    area_ += 0.5 * cross(corners_[k - 1] - corners_[0], corners_[k] - corners_[0]);
    cumulative_.push_back(area_);
  }
}

Eigen::Vector2d Footprint::point(double u, double v) const {
  if (is_domain_)
    return corners_[0] +
           Eigen::Vector2d(u * (corners_[1].x() - corners_[0].x()), v * (corners_[3].y() - corners_[0].y()));
  const double at = u * area_;
  const auto k = static_cast<std::size_t>(
      std::min(std::upper_bound(cumulative_.begin(), cumulative_.end(), at), cumulative_.end() - 1) -
      cumulative_.begin());
  const double before = k == 0 ? 0 : cumulative_[k - 1];
  const double along = std::sqrt(v);  // from the fan's corner outwards
  const double across = std::clamp((at - before) / (cumulative_[k] - before), 0.0, 1.0);
  const Eigen::Vector2d far_side = corners_[k + 1] + across * (corners_[k + 2] - corners_[k + 1]);
  return corners_[0] + along * (far_side - corners_[0]);
}

}  // namespace bpms
