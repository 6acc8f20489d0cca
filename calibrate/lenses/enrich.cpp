#include "calibrate/lenses/enrich.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "calibrate/lenses/splined.h"

namespace bpms {
namespace {

struct RayOfPixel {
  Eigen::Vector2d pixel;
  Eigen::Vector3d ray;
};

std::vector<RayOfPixel> rays_over_image(const Camera& camera) {
  std::vector<RayOfPixel> out;
  constexpr int steps = 40;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const Eigen::Vector2d pixel((camera.width_px - 1.0) * i / steps, (camera.height_px - 1.0) * j / steps);
      if (const auto ray = unproject(camera, pixel)) out.push_back({pixel, *ray});
    }
  }
  return out;
}

struct LensFit {
  Eigen::MatrixXd normal;
  Eigen::VectorXd gradient;
  double cost = 0;
  int used = 0;
};

LensFit linearised(const Camera& camera, const std::vector<RayOfPixel>& rays) {
  const auto n = static_cast<Eigen::Index>(camera.parameters.size());
  LensFit out{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  const Lens& lens = *find_lens(camera.model);
  const LensNumbers numbers{camera.parameters, camera.constants};
  for (const RayOfPixel& at : rays) {
    const auto there = lens.project_with_derivatives(numbers, at.ray);
    if (!there) continue;
    const Eigen::Vector2d r = at.pixel - there->pixel;
    out.normal.noalias() += there->by_parameters.transpose() * there->by_parameters;
    out.gradient.noalias() += there->by_parameters.transpose() * r;
    out.cost += r.squaredNorm();
    ++out.used;
  }
  for (const LensPrior& prior : lens.priors(numbers)) {
    double r = prior.value;
    for (const auto& [i, factor] : prior.coefficients)
      r -= factor * camera.parameters[static_cast<std::size_t>(i)];
    const double weight = 1 / (prior.sigma * prior.sigma);
    for (const auto& [i, a] : prior.coefficients) {
      out.gradient[i] += weight * a * r;
      for (const auto& [j, b] : prior.coefficients) out.normal(i, j) += weight * a * b;
    }
    out.cost += weight * r * r;
  }
  for (const int i : lens.held(numbers)) {
    out.normal.row(i).setZero();
    out.normal.col(i).setZero();
    out.normal(i, i) = 1;
    out.gradient[i] = 0;
  }
  return out;
}

}  // namespace

Camera enriched(const Camera& camera, const LensChoice& choice) {
  Camera out = camera;
  out.model = choice.model;
  out.constants = choice.model == "splined_stereographic" ? splined_constants(camera, choice.constants)
                                                          : choice.constants;
  out.parameters.resize(static_cast<std::size_t>(choice.parameters), 0.0);
  if (choice.model == camera.model && choice.constants == camera.constants) return out;
  std::fill(out.parameters.begin() + 4, out.parameters.end(), 0.0);
  const std::vector<RayOfPixel> rays = rays_over_image(camera);
  LensFit at = linearised(out, rays);
  double damping = 1e-9;
  constexpr int most_steps = 60;
  for (int step = 0; step < most_steps && at.used > 0; ++step) {
    Eigen::MatrixXd damped = at.normal;
    damped.diagonal() *= 1 + damping;
    const Eigen::VectorXd change = damped.ldlt().solve(at.gradient);
    Camera trial = out;
    for (std::size_t i = 0; i < trial.parameters.size(); ++i)
      trial.parameters[i] += change[static_cast<Eigen::Index>(i)];
    const LensFit there = linearised(trial, rays);
    constexpr double most_damping = 1e9, raise = 10;
    if (there.used >= at.used && there.cost < at.cost) {
      const bool done = at.cost - there.cost < 1e-9 * at.cost;
      out = trial, at = there, damping /= raise;
      if (done) break;
    } else if ((damping *= raise) > most_damping) {
      break;
    }
  }
  if (at.used < static_cast<int>(rays.size()) / 2)
    fail(ErrorKind::numeric, {}, "camera {}: the lens model {} cannot follow the first guess over the image",
         in_quotes(camera.name), choice.name);
  return out;
}

}  // namespace bpms
