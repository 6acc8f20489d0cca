// Rigs and sightings whose truth is known, and the statistics that tell whether covariances are honest.
#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "calibrate/rig.h"
#include "core/random.h"
#include "reconstruct/reconstruct.h"

namespace bpms::test {

inline Camera camera(const std::string& name, const Eigen::Vector3d& centre, const Eigen::Matrix3d& r,
                     std::vector<double> lens) {
  Camera out;
  out.name = name;
  out.width_px = 1600;
  out.height_px = 1200;
  out.parameters = std::move(lens);
  out.r_cam_from_rig = r;
  out.t_cam_from_rig_m = -r * centre;
  return out;
}

// Looks from `centre` at `target`, image y axis as near to rig y as may be.
inline Camera looking_at(const std::string& name, const Eigen::Vector3d& centre,
                         const Eigen::Vector3d& target) {
  const Eigen::Vector3d z = (target - centre).normalized();
  const Eigen::Vector3d x = Eigen::Vector3d::UnitY().cross(z).normalized();
  Eigen::Matrix3d r;
  r << x.transpose(), z.cross(x).transpose(), z.transpose();
  return camera(name, centre, r, {1800, 1790, 805, 596, -0.12, 0.06, 0.0008, -0.0005});
}

constexpr double parallel_focal_px = 3500, parallel_baseline_m = 0.3;

// Two pinholes side by side about the rig's origin.
inline Rig parallel_rig() {
  Rig rig;
  for (const double side : {-0.5, 0.5})
    rig.cameras.push_back(camera(side < 0 ? "left" : "right", {side * parallel_baseline_m, 0, 0},
                                 Eigen::Matrix3d::Identity(),
                                 {parallel_focal_px, parallel_focal_px, 800, 600}));
  return rig;
}

// Two or three distorting cameras that look at a point 1.5 m away.
inline Rig convergent_rig(int count) {
  const Eigen::Vector3d target(0, 0, 1.5);
  Rig rig;
  rig.cameras.push_back(looking_at("left", {-0.4, 0, 0}, target));
  rig.cameras.push_back(looking_at("right", {0.4, 0.02, 0.05}, target));
  if (count > 2) rig.cameras.push_back(looking_at("top", {0.05, -0.5, 0.1}, target));
  return rig;
}

// A dense covariance of all parameters of all cameras: plausible sigmas, random correlations.
inline void give_covariance(Rig& rig, double scale, std::uint64_t seed) {
  Rig::Covariance covariance;
  std::vector<double> sigma;
  for (const Camera& c : rig.cameras) {
    for (const std::string& name : parameter_names(c)) {
      covariance.order.push_back(c.name + "." + name);
      const char kind = name[0];
      sigma.push_back(scale * (kind == 'f' || kind == 'c' ? 0.5
                               : kind == 'k'              ? 2e-3
                               : kind == 'p'              ? 1e-4
                               : kind == 'r'              ? 3e-4
                                                          : 1e-4));
    }
  }
  const auto n = static_cast<Eigen::Index>(sigma.size());
  Philox random(seed, 99);
  Eigen::MatrixXd factor(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) factor(i, j) = random.normal();
  Eigen::MatrixXd correlation = factor * factor.transpose();
  const Eigen::VectorXd d = correlation.diagonal().cwiseSqrt().cwiseInverse();
  correlation = (d.asDiagonal() * correlation * d.asDiagonal()).eval();
  const Eigen::Map<const Eigen::VectorXd> s(sigma.data(), n);
  covariance.matrix = s.asDiagonal() * correlation * s.asDiagonal();
  rig.covariance = covariance;
}

// A rig whose parameters are off the given one's by a draw from its covariance.
inline Rig draw(const Rig& rig, Philox& random) {
  const Eigen::MatrixXd factor = rig.covariance->matrix.llt().matrixL();
  Eigen::VectorXd z(factor.cols());
  for (auto& value : z) value = random.normal();
  const Eigen::VectorXd error = factor * z;
  Rig out = rig;
  Eigen::Index at = 0;
  for (Camera& c : out.cameras) {
    for (double& p : c.parameters) p += error[at++];
    const Eigen::Vector3d w = error.segment<3>(at);
    c.r_cam_from_rig = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix() * c.r_cam_from_rig;
    c.t_cam_from_rig_m += error.segment<3>(at + 3);
    at += 6;
  }
  return out;
}

// The sightings of X; `random` null: without noise. Sigmas differ from camera to camera.
inline std::vector<Sighting> sight(const Rig& rig, const Eigen::Vector3d& x, double sigma_px,
                                   Philox* random) {
  std::vector<Sighting> out;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const double sigma = sigma_px * (i == 1 ? 1.5 : 1.0);
    Eigen::Vector2d pixel = project(rig.cameras[i], rig.cameras[i].camera_from_rig(x)).value();
    if (random != nullptr) pixel += sigma * Eigen::Vector2d(random->normal(), random->normal());
    out.push_back({static_cast<int>(i), pixel, sigma});
  }
  return out;
}

inline Eigen::Vector3d somewhere(Philox& random) {
  return {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(1.3, 1.7)};
}

// Points.csv rows as read: label rank 1 leaf midrib, point `number`, line number + 2.
inline std::vector<ImagePoint> image_points(const Rig& rig, int number,
                                            const std::vector<Sighting>& sightings) {
  std::vector<ImagePoint> out;
  for (const Sighting& s : sightings) {
    ImagePoint p;
    p.label = {"1", "1", 1, "leaf", "midrib"};
    p.point = number;
    p.view = "a";
    p.camera = rig.cameras[static_cast<std::size_t>(s.camera)].name;
    p.u_px = s.pixel.x();
    p.v_px = s.pixel.y();
    p.sigma_px = s.sigma_px;
    p.where = {"points.csv", number + 2, 1};
    out.push_back(p);
  }
  return out;
}

// Largest distance of the sample's distribution from the uniform one, times sqrt(n) (Kolmogorov 1933):
// above 1.95 with probability 0.001.
inline double kolmogorov(std::vector<double> p) {
  std::sort(p.begin(), p.end());
  const auto n = static_cast<double>(p.size());
  double largest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    largest = std::max(largest, static_cast<double>(i + 1) / n - p[i]);
    largest = std::max(largest, p[i] - static_cast<double>(i) / n);
  }
  return largest * std::sqrt(n);
}
constexpr double kolmogorov_limit = 1.95;

}  // namespace bpms::test
