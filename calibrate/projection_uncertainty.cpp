#include "calibrate/projection_uncertainty.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "calibrate/pose.h"
#include "calibrate/valid_region.h"
#include "core/error.h"
#include "core/statistics.h"

namespace bpms {
namespace {

using Rows = Eigen::Matrix<double, 2, Eigen::Dynamic>;

ProjectionMap empty_map(const Camera& camera, const MapOptions& options) {
  ProjectionMap out{options.range_m, options.columns, options.rows, {}, {}, {}};
  for (int i = 0; i < options.columns; ++i)
    out.x_px.push_back((i + 0.5) * camera.width_px / options.columns - 0.5);
  for (int j = 0; j < options.rows; ++j)
    out.y_px.push_back((j + 0.5) * camera.height_px / options.rows - 0.5);
  out.px.assign(static_cast<std::size_t>(options.columns * options.rows), NAN);
  return out;
}

// A point along a pixel's ray, in the camera's frame; unit distance stands for infinity.
struct MapPoint {
  std::size_t at = 0;
  Eigen::Vector2d pixel;
  Eigen::Vector3d x_cam;
  bool in_region = true;
};
std::vector<MapPoint> map_points(const Camera& camera, const ProjectionMap& map,
                                 const std::vector<Eigen::Vector2d>& region) {
  std::vector<MapPoint> out;
  for (std::size_t k = 0; k < map.px.size(); ++k) {
    const auto columns = static_cast<std::size_t>(map.columns);
    const Eigen::Vector2d pixel(map.x_px[k % columns], map.y_px[k / columns]);
    if (const auto ray = unproject(camera, pixel))
      out.push_back({k, pixel, (map.range_m > 0 ? map.range_m : 1) * *ray,
                     region.empty() || inside_hull(region, pixel)});
  }
  return out;
}

// Derivatives by the motion of the camera that can be taken off: a turn, and a shift where the range is
// finite.
Rows by_motion(const Projection& at, double range_m) {
  return range_m > 0 ? Rows(at.by_pose) : Rows(at.by_pose.leftCols<3>());
}

Camera at_origin(Camera camera) {
  camera.r_cam_from_rig.setIdentity();
  camera.t_cam_from_rig_m.setZero();
  return camera;
}

}  // namespace

double ProjectionMap::quantile(double q) const {
  std::vector<double> numbers;
  std::copy_if(px.begin(), px.end(), std::back_inserter(numbers), [](double v) { return std::isfinite(v); });
  return bpms::quantile(std::move(numbers), q);
}

Eigen::MatrixXd lens_covariance(const Rig::Covariance& covariance, const Camera& camera) {
  const std::vector<std::string> names = parameter_names(camera);
  const auto n = static_cast<Eigen::Index>(camera.parameters.size());
  std::vector<Eigen::Index> column(camera.parameters.size(), -1);
  for (std::size_t i = 0; i < column.size(); ++i) {
    const auto found =
        std::find(covariance.order.begin(), covariance.order.end(), camera.name + "." + names[i]);
    if (found != covariance.order.end()) column[i] = found - covariance.order.begin();
  }
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Index a = column[static_cast<std::size_t>(i)], b = column[static_cast<std::size_t>(j)];
      if (a >= 0 && b >= 0) out(i, j) = covariance.matrix(a, b);
    }
  }
  return out;
}

// dq = L db + P m with the motion m(db) = -(P'P)^-1 P'L db summed over the region.
ProjectionMap projection_uncertainty(const Camera& camera, const Eigen::MatrixXd& covariance,
                                     const MapOptions& options) {
  ProjectionMap out = empty_map(camera, options);
  const Camera eye = at_origin(camera);
  const std::vector<MapPoint> points = map_points(eye, out, options.region);
  const Eigen::Index motion = options.range_m > 0 ? 6 : 3, n = covariance.rows();
  Eigen::MatrixXd pp = Eigen::MatrixXd::Zero(motion, motion), pl = Eigen::MatrixXd::Zero(motion, n);
  std::vector<std::optional<Projection>> at;
  for (const MapPoint& point : points) {
    at.push_back(project_with_derivatives(eye, point.x_cam));
    if (!at.back() || !point.in_region) continue;
    const Rows p = by_motion(*at.back(), options.range_m);
    pp.noalias() += p.transpose() * p;
    pl.noalias() += p.transpose() * at.back()->by_parameters;
  }
  if (points.size() < 4) return out;
  const Eigen::MatrixXd taken_off = pp.ldlt().solve(pl);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!at[k]) continue;
    const Eigen::MatrixXd a = at[k]->by_parameters - by_motion(*at[k], options.range_m) * taken_off;
    const Eigen::Matrix2d variance = a * covariance * a.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(variance, Eigen::EigenvaluesOnly);
    out.px[points[k].at] = std::sqrt(std::max(0.0, eigen.eigenvalues()[1]));
  }
  return out;
}

ProjectionMap projection_difference(const Camera& camera, const Camera& other, const MapOptions& options) {
  ProjectionMap out = empty_map(camera, options);
  const std::vector<MapPoint> points = map_points(at_origin(camera), out, options.region);
  Camera moved = at_origin(other);
  const Eigen::Index motion = options.range_m > 0 ? 6 : 3;
  constexpr int steps = 20;
  constexpr double robust_px = 0.5;  // the middle of the image decides, not where one of the lenses runs wild
  for (int step = 0; step < steps; ++step) {
    Eigen::MatrixXd pp = Eigen::MatrixXd::Zero(motion, motion);
    Eigen::VectorXd pr = Eigen::VectorXd::Zero(motion);
    for (const MapPoint& point : points) {
      const auto at = project_with_derivatives(moved, point.x_cam);
      if (!at || !point.in_region) continue;
      const Eigen::Vector2d r = point.pixel - at->pixel;
      const double weight = 1 / (1 + r.squaredNorm() / (robust_px * robust_px));
      const Rows p = by_motion(*at, options.range_m);
      pp.noalias() += weight * p.transpose() * p;
      pr.noalias() += weight * p.transpose() * r;
    }
    const Eigen::VectorXd change = pp.ldlt().solve(pr);
    if (!change.allFinite()) break;
    moved.r_cam_from_rig = orthonormalised(rotation_from_vector(change.head<3>()) * moved.r_cam_from_rig);
    if (motion == 6) moved.t_cam_from_rig_m += change.tail<3>();
  }
  for (const MapPoint& point : points)
    if (const auto pixel = project(moved, moved.camera_from_rig(point.x_cam)))
      out.px[point.at] = (*pixel - point.pixel).norm();
  return out;
}

}  // namespace bpms
