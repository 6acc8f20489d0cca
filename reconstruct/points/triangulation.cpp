#include "reconstruct/points/triangulation.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>

namespace bpms {
namespace {

// Rays that differ by less than this many standard errors of their angle say nothing about the distance; the
// same bound on range/sigma(range) keeps the Gaussian covariance meaningful.
constexpr double least_significance = 3.0;

struct Ray {
  Eigen::Vector3d centre;     // of the camera, rig frame
  Eigen::Vector3d direction;  // unit, rig frame
  double sigma_rad;
};

std::optional<std::vector<Ray>> rays_of(const std::vector<Sighting>& sightings, const Rig& rig) {
  std::vector<Ray> rays;
  for (const Sighting& s : sightings) {
    const Camera& camera = rig.cameras[static_cast<std::size_t>(s.camera)];
    const auto ray = unproject(camera, s.pixel);
    if (!ray) return std::nullopt;
    // The angle of one pixel, towards whichever side the lens model covers.
    double angle = 0;
    for (const double step : {1.0, -1.0}) {
      const auto beside = unproject(camera, s.pixel + Eigen::Vector2d(step, 0));
      if (beside) angle = std::max(angle, std::atan2(ray->cross(*beside).norm(), ray->dot(*beside)));
    }
    const Eigen::Matrix3d rig_from_cam = camera.r_cam_from_rig.transpose();
    rays.push_back({-rig_from_cam * camera.t_cam_from_rig_m, rig_from_cam * *ray, angle * s.sigma_px});
  }
  return rays;
}

bool parallel(const std::vector<Ray>& rays) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double angle = std::atan2(rays[i].direction.cross(rays[j].direction).norm(),
                                      rays[i].direction.dot(rays[j].direction));
      if (angle > least_significance * std::hypot(rays[i].sigma_rad, rays[j].sigma_rad)) return false;
    }
  }
  return true;
}

// The homogeneous point X with d_i x (X - c_i) = 0 for all rays, in units of the rig's extent about its
// middle.
std::optional<Eigen::Vector3d> linear_start(const std::vector<Ray>& rays) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Ray& ray : rays) middle += ray.centre / static_cast<double>(rays.size());
  double extent = 0;
  for (const Ray& ray : rays) extent = std::max(extent, (ray.centre - middle).norm());
  if (extent == 0) return std::nullopt;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  for (const Ray& ray : rays) {
    const Eigen::Vector3d& d = ray.direction;
    Eigen::Matrix<double, 3, 4> row;
    row.leftCols<3>() << 0, -d.z(), d.y(), d.z(), 0, -d.x(), -d.y(), d.x(), 0;
    row.col(3) = -d.cross((ray.centre - middle) / extent);
    normal += row.transpose() * row / (ray.sigma_rad * ray.sigma_rad);
  }
  const Eigen::Vector4d x = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(normal).eigenvectors().col(0);
  constexpr double least_weight = 1e-12;  // of a unit vector: a point at 1e12 rig extents
  if (std::abs(x[3]) < least_weight) return std::nullopt;
  return middle + extent * x.head<3>() / x[3];
}

// Residuals and derivatives at X; false where a camera does not see X.
bool evaluate(const std::vector<Sighting>& sightings, const Rig& rig, const Eigen::Vector3d& x,
              Triangulation& out) {
  const auto rows = static_cast<Eigen::Index>(2 * sightings.size());
  out.x_m = x;
  out.residual.resize(rows);
  out.by_point.resize(rows, 3);
  out.projections.clear();
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Sighting& s = sightings[i];
    const auto projection = project_with_derivatives(rig.cameras[static_cast<std::size_t>(s.camera)], x);
    if (!projection) return false;
    const auto row = static_cast<Eigen::Index>(2 * i);
    out.residual.segment<2>(row) = (s.pixel - projection->pixel) / s.sigma_px;
    out.by_point.middleRows<2>(row) = projection->by_point / s.sigma_px;
    out.projections.push_back(*projection);
  }
  return true;
}

bool gauss_newton(const std::vector<Sighting>& sightings, const Rig& rig, Triangulation& at) {
  constexpr int most_steps = 100, most_halvings = 30;
  // Squared lengths of steps in standard errors: done; and so near that rounding hides whether the sum
  // shrinks.
  constexpr double done = 1e-18, near = 1e-6;
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::Matrix3d normal = at.by_point.transpose() * at.by_point;
    const Eigen::Vector3d delta = normal.ldlt().solve(at.by_point.transpose() * at.residual);
    if (!delta.allFinite()) return false;
    const double length = delta.dot(normal * delta);
    if (length < done) return true;
    bool taken = false;
    double share = 1;
    for (int halving = 0; halving < most_halvings && !taken; ++halving, share /= 2) {
      Triangulation next;
      if (!evaluate(sightings, rig, at.x_m + share * delta, next)) continue;
      if (length > near && next.residual.squaredNorm() >= at.residual.squaredNorm()) continue;
      at = std::move(next);
      taken = true;
    }
    if (!taken) return false;
  }
  return false;
}

}  // namespace

Triangulation triangulate(const std::vector<Sighting>& sightings, const Rig& rig) {
  Triangulation out;
  const auto failed = [&](const char* reason) {
    out.failure = reason;
    return out;
  };
  if (sightings.size() < 2) return failed("seen in one image only");
  const auto rays = rays_of(sightings, rig);
  if (!rays) return failed("outside the lens model");
  if (parallel(*rays)) return failed("parallel rays");
  const auto start = linear_start(*rays);
  if (!start) return failed("parallel rays");
  for (const Sighting& s : sightings) {
    if (rig.cameras[static_cast<std::size_t>(s.camera)].camera_from_rig(*start).z() <= 0)
      return failed("behind a camera");
  }
  if (!evaluate(sightings, rig, *start, out)) return failed("outside the lens model");
  if (!gauss_newton(sightings, rig, out)) return failed("did not converge");
  const Eigen::Matrix3d normal = out.by_point.transpose() * out.by_point;
  out.covariance_m2 = normal.ldlt().solve(Eigen::Matrix3d::Identity());
  out.covariance_m2 = (0.5 * (out.covariance_m2 + out.covariance_m2.transpose())).eval();
  const Eigen::Vector3d variances =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(out.covariance_m2).eigenvalues();
  double range = (out.x_m - rays->front().centre).norm();
  for (const Ray& ray : *rays) range = std::min(range, (out.x_m - ray.centre).norm());
  const bool determined = out.covariance_m2.allFinite() && variances.minCoeff() > 0;
  if (!determined || least_significance * std::sqrt(variances.maxCoeff()) > range)
    return failed("parallel rays");
  return out;
}

}  // namespace bpms
