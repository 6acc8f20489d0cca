#include "scene/structure/footprint.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Points of a prototype whose hull is near its own: of a disc and of a shape, points on the rim that is seen
// along a direction (`up`).
void outline(const Prototype& prototype, const Eigen::Vector3d& up, std::vector<Eigen::Vector3d>& points) {
  constexpr int rim_points = 24;
  const Eigen::Vector3d across = up.unitOrthogonal(), along = up.cross(across);
  for (int k = 0; k < rim_points; ++k) {
    const double t = 2 * pi * k / rim_points;
    const Eigen::Vector3d d = std::cos(t) * across + std::sin(t) * along;
    for (const Disc& disc : prototype.discs) {
      const Eigen::Vector3d n = disc.normal.cast<double>(), in_plane = d - d.dot(n) * n;
      const double length = in_plane.norm();
      points.push_back(disc.centre_m.cast<double>());
      if (length > 0) points.back() += disc.radius_m / length * in_plane;
    }
    for (const Shape& shape : prototype.shapes) points.push_back(shape_support(shape, d));
  }
  if (prototype.mesh)
    for (const Eigen::Vector3f& p : prototype.mesh->positions_m) points.push_back(p.cast<double>());
}

// The plan view's hull of a prototype under a rotation.
std::vector<Eigen::Vector2d> hull(const Prototype& prototype, const Rotation& rotation) {
  std::vector<Eigen::Vector3d> points;
  outline(prototype, rotation.back(Eigen::Vector3d::UnitZ()), points);
  std::vector<Eigen::Vector2d> plan;
  plan.reserve(points.size());
  for (const Eigen::Vector3d& p : points) plan.push_back((rotation * p).head<2>());
  return convex_hull(std::move(plan));
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
    for (const Prototype& prototype : scene.prototypes) hulls.push_back(hull(prototype, {}));
    std::vector<Eigen::Vector2d> all;
    const auto add = [&](const Instance& i, const Eigen::Vector2d& p) {
      all.push_back(i.position_m.head<2>() + i.scale * p);
      constexpr std::size_t many = 10'000'000;
      if (all.size() > many) all = convex_hull(std::move(all));
    };
    for (const Instance& i : scene.instances) {
      if (i.rotation.upright()) {
        for (const Eigen::Vector2d& p : hulls[i.prototype])
          add(i, (i.rotation * Eigen::Vector3d(p.x(), p.y(), 0)).head<2>());
      } else {
        for (const Eigen::Vector2d& p : hull(scene.prototypes[i.prototype], i.rotation)) add(i, p);
      }
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
