#include "calibrate/rig.h"

#include <ceres/jet.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "calibrate/brown_conrady.h"

namespace bpms {
namespace {

int parameter_count(const Camera& camera) {
  return static_cast<int>(camera.parameters.size());
}

// Distorted normalised coordinates and their 2x2 derivative.
struct Distorted {
  Eigen::Vector2d value;
  Eigen::Matrix2d jacobian;
};
Distorted distort(const Camera& camera, const Eigen::Vector2d& x) {
  using Dual = ceres::Jet<double, 2>;
  std::array<Dual, 12> parameters;
  std::transform(camera.parameters.begin(), camera.parameters.end(), parameters.begin(),
                 [](double p) { return Dual(p); });
  Dual xd, yd;
  brown_conrady::distort(parameters.data(), parameter_count(camera), Dual(x.x(), 0), Dual(x.y(), 1), xd, yd);
  Distorted out{{xd.a, yd.a}, {}};
  out.jacobian << xd.v.transpose(), yd.v.transpose();
  return out;
}

bool inside_monotone_region(const Camera& camera, const Eigen::Vector2d& x) {
  return brown_conrady::monotone_up_to(camera.parameters.data(), parameter_count(camera), x.squaredNorm());
}

}  // namespace

int Rig::find(const std::string& camera) const {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].name == camera) return static_cast<int>(i);
  }
  return -1;
}

std::vector<std::string> parameter_names(const Camera& camera) {
  static const char* const lens[] = {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  std::vector<std::string> names(lens, lens + camera.parameters.size());
  for (const char* name : {"rx", "ry", "rz", "tx", "ty", "tz"}) names.emplace_back(name);
  return names;
}

std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& x_cam) {
  if (!(x_cam.z() > 0)) return std::nullopt;
  if (!inside_monotone_region(camera, x_cam.hnormalized())) return std::nullopt;
  Eigen::Vector2d pixel;
  brown_conrady::project(camera.parameters.data(), parameter_count(camera), x_cam.data(), pixel.data());
  if (!pixel.allFinite()) return std::nullopt;
  return pixel;
}

std::optional<Projection> project_with_derivatives(const Camera& camera, const Eigen::Vector3d& x_rig) {
  const Eigen::Vector3d rotated = camera.r_cam_from_rig * x_rig, x_cam = rotated + camera.t_cam_from_rig_m;
  const auto local =
      brown_conrady::project_with_derivatives(camera.parameters.data(), parameter_count(camera), x_cam);
  if (!local) return std::nullopt;
  Projection out;
  out.pixel = local->pixel;
  out.by_parameters = local->by_parameters;
  out.by_point = local->by_x_cam * camera.r_cam_from_rig;
  Eigen::Matrix3d cross;  // d(exp(w) a)/dw = -[a]x at w = 0
  cross << 0, -rotated.z(), rotated.y(), rotated.z(), 0, -rotated.x(), -rotated.y(), rotated.x(), 0;
  out.by_pose << -local->by_x_cam * cross, local->by_x_cam;
  return out;
}

std::optional<Eigen::Vector3d> unproject(const Camera& camera, const Eigen::Vector2d& pixel) {
  const std::vector<double>& p = camera.parameters;
  const Eigen::Vector2d target((pixel.x() - p[2]) / p[0], (pixel.y() - p[3]) / p[1]);
  if (!target.allFinite()) return std::nullopt;
  Eigen::Vector2d x = inside_monotone_region(camera, target) ? target : Eigen::Vector2d::Zero();
  Distorted at = distort(camera, x);
  double error = (at.value - target).norm();
  const double enough = 1e-14 * (1 + target.norm());
  constexpr int most_steps = 50, most_halvings = 30;
  for (int i = 0; i < most_steps && error > enough; ++i) {
    if (!(at.jacobian.determinant() > 0)) return std::nullopt;
    const Eigen::Vector2d step = at.jacobian.inverse() * (target - at.value);
    bool better = false;
    for (double scale = 1; !better && scale > std::ldexp(1.0, -most_halvings); scale /= 2) {
      const Eigen::Vector2d trial = x + scale * step;
      if (!trial.allFinite() || !inside_monotone_region(camera, trial)) continue;
      const Distorted there = distort(camera, trial);
      const double trial_error = (there.value - target).norm();
      if (!(trial_error < error)) continue;
      x = trial, at = there, error = trial_error, better = true;
    }
    if (!better) break;  // rounding, or the edge of the region: the residual tells which
  }
  constexpr double tolerance = 1e-11;
  if (!(error < tolerance * (1 + target.norm())) || !(at.jacobian.determinant() > 0)) return std::nullopt;
  return Eigen::Vector3d(x.x(), x.y(), 1).normalized();
}

}  // namespace bpms
