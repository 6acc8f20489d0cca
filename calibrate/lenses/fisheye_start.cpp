#include "calibrate/lenses/fisheye_start.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "core/units.h"

namespace bpms {
namespace {

Eigen::Vector3d equidistant_ray(const Eigen::Vector2d& from_centre, double focal_px) {
  const double r = from_centre.norm();
  if (r == 0) return Eigen::Vector3d::UnitZ();
  const double theta = r / focal_px;
  const Eigen::Vector2d side = std::sin(theta) / r * from_centre;
  return {side.x(), side.y(), std::cos(theta)};
}

Eigen::Vector2d equidistant_pixel(const Eigen::Vector3d& x, double focal_px) {
  const double r = x.head<2>().norm();
  return r > 0 ? Eigen::Vector2d(focal_px * std::atan2(r, x.z()) / r * x.head<2>()) : Eigen::Vector2d(0, 0);
}

// Points in the plane z = 0 of a frame of their own.
struct PlaneOfView {
  Pose plane_from_target;
  std::vector<Eigen::Vector2d> points_m;
  std::vector<Eigen::Vector2d> from_centre;  // pixels
};

PlaneOfView plane_of(const FlatView& view, const Eigen::Vector2d& centre) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& x : view.points_m) mean += x / static_cast<double>(view.points_m.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& x : view.points_m) spread += (x - mean) * (x - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  PlaneOfView out;
  Eigen::Matrix3d r;
  const Eigen::Vector3d x = axes.eigenvectors().col(2), y = axes.eigenvectors().col(1);
  r << x, y, x.cross(y);
  out.plane_from_target = {r.transpose(), -(r.transpose() * mean)};
  for (const auto& point : view.points_m)
    out.points_m.emplace_back((out.plane_from_target * point).head<2>());
  for (const auto& pixel : view.pixels) out.from_centre.push_back(pixel - centre);
  return out;
}

// Poses of all views at a focal length, and the median of the reprojection errors.
FisheyeStart at_focal_length(const std::vector<PlaneOfView>& views, double focal_px) {
  FisheyeStart out;
  out.focal_px = focal_px;
  std::vector<double> errors;
  for (const PlaneOfView& view : views) {
    std::vector<Eigen::Vector3d> rays;
    for (const auto& q : view.from_centre) rays.push_back(equidistant_ray(q, focal_px));
    const auto pose = pose_from_rays(view.points_m, rays);
    out.camera_from_target.push_back(pose ? std::optional(*pose * view.plane_from_target) : std::nullopt);
    for (std::size_t i = 0; i < view.points_m.size(); ++i) {
      if (!pose) continue;
      const Eigen::Vector3d x = *pose * Eigen::Vector3d(view.points_m[i].x(), view.points_m[i].y(), 0);
      errors.push_back((equidistant_pixel(x, focal_px) - view.from_centre[i]).norm());
    }
  }
  out.median_px = errors.empty() ? HUGE_VAL : median(std::move(errors));
  return out;
}

}  // namespace

std::optional<Pose> pose_from_rays(const std::vector<Eigen::Vector2d>& plane_m,
                                   const std::vector<Eigen::Vector3d>& rays) {
  if (plane_m.size() < 4 || plane_m.size() != rays.size()) return std::nullopt;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : plane_m) mean += p / static_cast<double>(plane_m.size());
  double size = 0;
  for (const auto& p : plane_m) size += (p - mean).norm() / static_cast<double>(plane_m.size());
  if (!(size > 0)) return std::nullopt;
  // ray x (H p) = 0, rows of H behind each other.
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (std::size_t i = 0; i < plane_m.size(); ++i) {
    const Eigen::Vector3d p = ((plane_m[i] - mean) / size).homogeneous();
    Eigen::Matrix<double, 3, 9> rows = Eigen::Matrix<double, 3, 9>::Zero();
    const Eigen::Matrix3d cross = cross_matrix(rays[i]);
    for (int k = 0; k < 3; ++k) rows.middleCols<3>(3 * k) = cross.col(k) * p.transpose();
    normal += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> eigen(normal);
  constexpr double rank_tolerance = 1e-10;
  if (!(eigen.eigenvalues()[1] > rank_tolerance * eigen.eigenvalues()[8])) return std::nullopt;
  const Eigen::Matrix<double, 9, 1> h = eigen.eigenvectors().col(0);
  Eigen::Matrix3d m;
  m << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8];
  double along = 0;
  for (std::size_t i = 0; i < plane_m.size(); ++i)
    along += rays[i].dot(m * Eigen::Vector3d(((plane_m[i] - mean) / size).homogeneous()));
  const double scale = std::sqrt(m.col(0).norm() * m.col(1).norm());
  if (!(scale > 0)) return std::nullopt;
  m /= along < 0 ? -scale : scale;
  Eigen::Matrix3d r;
  r << m.col(0), m.col(1), m.col(0).cross(m.col(1));
  r = orthonormalised(r);
  return Pose{r, size * m.col(2) - r * Eigen::Vector3d(mean.x(), mean.y(), 0)};
}

std::optional<FisheyeStart> fisheye_start(const std::vector<FlatView>& views, int width_px, int height_px) {
  const Eigen::Vector2d centre(0.5 * (width_px - 1), 0.5 * (height_px - 1));
  std::vector<PlaneOfView> planes;
  double farthest = 0;
  for (const FlatView& view : views) {
    planes.push_back(plane_of(view, centre));
    for (const auto& q : planes.back().from_centre) farthest = std::max(farthest, q.norm());
  }
  if (!(farthest > 0)) return std::nullopt;
  // The farthest corner between 5 and 120 degrees from the axis.
  constexpr double narrowest = radians(5.0), widest = radians(120.0);
  constexpr int steps = 48;
  const double ratio = std::pow(narrowest / widest, 1.0 / steps);
  FisheyeStart best;
  best.median_px = HUGE_VAL;
  double angle = widest;
  for (int i = 0; i <= steps; ++i, angle *= ratio) {
    FisheyeStart here = at_focal_length(planes, farthest / angle);
    if (here.median_px < best.median_px) best = std::move(here);
  }
  if (!(best.median_px < HUGE_VAL)) return std::nullopt;
  double factor = 1 / ratio;
  constexpr int halvings = 8;
  for (int i = 0; i < halvings; ++i) {  // the minimum lies between the neighbours on the grid
    factor = std::sqrt(factor);
    for (const double f : {best.focal_px * factor, best.focal_px / factor}) {
      FisheyeStart here = at_focal_length(planes, f);
      if (here.median_px < best.median_px) best = std::move(here);
    }
  }
  return best;
}

}  // namespace bpms
