#include "calibrate/calibrate.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "calibrate/adjustment/bundle_adjustment.h"
#include "calibrate/adjustment/outliers.h"
#include "calibrate/adjustment/turntable.h"
#include "calibrate/adjustment/uncertainty.h"
#include "calibrate/describe.h"
#include "calibrate/lenses/lens.h"
#include "calibrate/network_problem.h"
#include "calibrate/projection_uncertainty.h"
#include "calibrate/valid_region.h"
#include "core/text.h"

namespace bpms {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A Gauss-Newton step from the solution must be small beside the errors (1e-3 sigma) or beside rounding (1e-9
// px).
bool stationary(const NormalEquations& equations, const Eigen::MatrixXd& cofactors) {
  const Eigen::VectorXd score = equations.score();
  const double decrement = score.dot(cofactors * score) + equations.pose_decrement;
  constexpr double of_sigma = 1e-3, rounding_px = 1e-9;
  return decrement < std::pow(of_sigma * equations.sigma_px(), 2) ||
         decrement < rounding_px * rounding_px * equations.observations;
}

void require_sound_lenses(const Observations& observations, const std::vector<Camera>& cameras) {
  for (const Camera& camera : cameras) {
    if (!(camera.parameters[0] > 0) || !(camera.parameters[1] > 0))
      fail(ErrorKind::numeric, {},
           "camera {} came out with focal lengths {:.6g}, {:.6g}: the views do not suit the model",
           in_quotes(camera.name), camera.parameters[0], camera.parameters[1]);
    // Where an image need not fill its frame, what lies between the corners seen must be sound.
    const std::vector<Eigen::Vector2d> region =
        find_lens(camera.model)->covers_image()
            ? std::vector<Eigen::Vector2d>()
            : valid_region(observations, static_cast<int>(&camera - cameras.data()));
    if (const auto pixel = pixel_without_ray(camera, region))
      fail(ErrorKind::numeric, {},
           "the distortion of camera {} folds or has a pole inside the image, near pixel ({:.0f}, {:.0f}): "
           "ask for fewer "
           "lens parameters, or show the target near the image's edges",
           in_quotes(camera.name), pixel->x(), pixel->y());
  }
}

struct Half {
  std::vector<Camera> cameras;
  std::optional<TurntableAxis> axis;
  std::vector<double> baseline_sigma_m;  // of the first pair, if there is one
};
Half half_set(const BundleProblem& problem, const BundleState& solution, const std::vector<bool>& keep) {
  BundleProblem half = problem;
  std::erase_if(half.corners,
                [&](const CornerObservation& c) { return !keep[static_cast<std::size_t>(c.frame)]; });
  const BundleState state = solve_subset(half, solution, keep);
  const NormalEquations equations = normal_equations(half, state);
  std::vector<CameraPair> pairs;
  if (state.cameras.size() > 1) pairs.push_back({0, 1});
  return {state.cameras,
          problem.turntable() ? std::optional(turntable_axis(state.rig_from_world[0])) : std::nullopt,
          clustered_by_frame(half, state, equations, cofactors(equations), pairs).baseline_sigma_m};
}

void add_half_sets(const BundleProblem& problem, const BundleState& state,
                   const std::vector<MapOptions>& maps, Calibration& out) {
  std::vector<bool> keep;
  for (int f = 0; f < problem.frames; ++f) keep.push_back(f % 2 == 0);
  try {
    const Half odd = half_set(problem, state, keep);
    keep.flip();
    const Half even = half_set(problem, state, keep);
    Calibration::HalfSets result;
    if (state.cameras.size() > 1) {
      result.odd_baseline_m = relative_pose(odd.cameras, 0, 1).t_m.norm();
      result.even_baseline_m = relative_pose(even.cameras, 0, 1).t_m.norm();
      result.sigma_clustered_m = std::hypot(odd.baseline_sigma_m[0], even.baseline_sigma_m[0]);
    }
    for (std::size_t c = 0; c < state.cameras.size(); ++c)
      result.difference.push_back(projection_difference(odd.cameras[c], even.cameras[c], maps[c]));
    if (odd.axis) {
      out.turntable->halves_angle_rad = odd.axis->direction.cross(even.axis->direction).norm();
      out.turntable->halves_distance_m = (odd.axis->point_m - even.axis->point_m).norm();
    }
    out.half_sets = std::move(result);
  } catch (const Error& error) {  // too few frames for halves: the report has none
    if (error.kind() != ErrorKind::numeric) throw;
  }
}

// A focal length that could as well be several percent off, or a principal point by a tenth of the image, is
// not known, whatever number came out.
void require_determined(const std::vector<Camera>& cameras, const NormalEquations& equations,
                        const Eigen::VectorXd& sigma) {
  constexpr double of_focal = 0.05, of_width = 0.1;
  std::string unknown;
  for (std::size_t i = 0; i < equations.order.size(); ++i) {
    for (const Camera& camera : cameras) {
      for (std::size_t k = 0; k < 4; ++k) {
        static const char* const names[] = {"fx", "fy", "cx", "cy"};
        if (equations.order[i] != camera.name + "." + names[k]) continue;
        const double limit = k < 2 ? of_focal * camera.parameters[k] : of_width * camera.width_px;
        if (sigma[static_cast<Eigen::Index>(i)] > limit)
          unknown +=
              fmt::format("{}{} = {:.5g} +- {:.2g} px", unknown.empty() ? "" : ", ", equations.order[i],
                          camera.parameters[k], sigma[static_cast<Eigen::Index>(i)]);
      }
    }
  }
  if (!unknown.empty())
    fail(ErrorKind::numeric, {},
         "the views do not determine {}: show the target tilted by 30 to 45 degrees in several directions",
         unknown);
}

double largest_sigma(const Eigen::Matrix3d& covariance) {
  return std::sqrt(
      std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[2]));
}

Calibration::Turntable describe_turntable(const BundleState& state, const NormalEquations& equations,
                                          const Eigen::MatrixXd& inverse) {
  const Pose& table = state.rig_from_world[0];
  const TurntableAxis axis = turntable_axis(table);
  Calibration::Turntable out;
  out.direction = axis.direction;
  out.point_m = axis.point_m;
  const auto at =
      std::find(equations.names.begin(), equations.names.end(), "the pose (rx) of the turntable") -
      equations.names.begin();
  const Eigen::Matrix<double, 6, 6> d = axis_derivatives(table);
  const auto sigmas = [&](const Eigen::MatrixXd& covariance, double& turn, double& shift) {
    const Eigen::Matrix<double, 6, 6> block = d * covariance.block<6, 6>(at, at) * d.transpose();
    turn = largest_sigma(block.topLeftCorner<3, 3>());
    shift = largest_sigma(block.bottomRightCorner<3, 3>());
  };
  sigmas(std::pow(equations.sigma_px(), 2) * inverse, out.direction_sigma_rad, out.point_sigma_m);
  sigmas(sandwich(equations, inverse), out.direction_sigma_clustered_rad, out.point_sigma_clustered_m);
  return out;
}

std::vector<CameraPair> all_pairs(std::size_t cameras) {
  std::vector<CameraPair> out;
  for (int a = 0; a < static_cast<int>(cameras); ++a) {
    for (int b = a + 1; b < static_cast<int>(cameras); ++b) out.push_back({a, b});
  }
  return out;
}

}  // namespace

Calibration calibrate(const Observations& observations, const std::vector<Target>& targets,
                      const CalibrateOptions& options) {
  const Clock::time_point start = Clock::now();
  require_views(observations, options.rig_moves || options.table_step_rad != 0);
  const std::vector<std::string> frames = frame_names(observations);
  BundleProblem problem = network_problem(observations, targets, frames, options);
  BundleState state = first_state(problem, observations.cameras, lens_choice(options.lens));
  const OutlierSearch search =
      fit_without_outliers(problem, static_cast<int>(observations.views.size()), state);
  const NormalEquations equations = normal_equations(problem, state);
  if (equations.observations <= equations.parameters)
    fail(ErrorKind::numeric, {}, "{} coordinates cannot determine {} parameters", equations.observations,
         equations.parameters);
  const Eigen::MatrixXd inverse = cofactors(equations);
  const auto n = static_cast<Eigen::Index>(equations.order.size());
  const Eigen::VectorXd sigma_iid = equations.sigma_px() * inverse.diagonal().head(n).cwiseSqrt();
  require_determined(state.cameras, equations, sigma_iid);  // first: it explains the rest
  require_sound_lenses(observations, state.cameras);
  if (!search.last.converged || !stationary(equations, inverse))
    fail(ErrorKind::numeric, {}, "the adjustment did not converge (residual rms {:.3g} px after {} steps)",
         equations.rms_px(), search.last.iterations);

  Calibration out;
  out.converged = true;
  out.frames = static_cast<int>(equations.frames.size());
  out.rig.cameras = state.cameras;
  out.rig.residual_sigma_px = out.residual_sigma_px = equations.sigma_px();
  out.residual_rms_px = equations.rms_px();
  out.degrees_of_freedom = equations.observations - equations.parameters;
  describe_targets(observations, problem, state, out);
  out.poses = {frames, state.rig_from_world, state.world_from_target};
  describe_views(observations, problem, state, search, out);
  out.sigma_iid = sigma_iid;
  if (problem.turntable()) out.turntable = describe_turntable(state, equations, inverse);
  std::vector<MapOptions> maps;
  for (const double range_m : usual_ranges(problem, state))
    maps.push_back({.range_m = range_m, .region = valid_region(observations, static_cast<int>(maps.size()))});
  const std::vector<CameraPair> pairs = all_pairs(state.cameras.size());
  for (const CameraPair& pair : pairs) {
    const Pose pose = relative_pose(state.cameras, pair.a, pair.b);
    const Eigen::VectorXd gradient =
        baseline_gradient(problem, state.cameras, pair.a, pair.b, inverse.rows());
    out.pairs.push_back({pair.a, pair.b, pose.t_m.norm(),
                         equations.sigma_px() * std::sqrt(gradient.dot(inverse * gradient)), std::nullopt,
                         vector_from_rotation(pose.r), pose.t_m});
  }
  out.solve_seconds = seconds_since(start);

  const Clock::time_point uncertainty_start = Clock::now();
  // Of what is projected, numbers that err against each other cancel: the maps need the covariance by frame
  // as it is, not the one scaled for the file.
  Rig::Covariance for_maps{equations.order, std::pow(equations.sigma_px(), 2) * inverse.topLeftCorner(n, n),
                           "iid"};
  if (options.uncertainty) {
    try {
      const Clustered clustered = clustered_by_frame(problem, state, equations, inverse, pairs);
      out.sigma_clustered = clustered.sigma;
      for_maps = {equations.order, clustered.covariance, "clustered"};
      for (std::size_t i = 0; i < pairs.size(); ++i)
        out.pairs[i].baseline_sigma_clustered_m = clustered.baseline_sigma_m[i];
      add_half_sets(problem, state, maps, out);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::numeric) throw;
      out.clustered_absent = error.message();
    }
  }
  const bool clustered = out.sigma_clustered.size() == n;
  out.rig.covariance =
      rig_covariance(equations, inverse, out.sigma_iid, clustered ? out.sigma_clustered : out.sigma_iid,
                     clustered ? "clustered" : "iid");
  if (clustered) {
    out.rig.covariance->frames = out.frames;
    out.rig.covariance->sigma_iid = out.sigma_iid;
  }
  for (std::size_t c = 0; c < state.cameras.size(); ++c)
    out.projection.push_back(
        projection_uncertainty(state.cameras[c], lens_covariance(for_maps, state.cameras[c]), maps[c]));
  out.uncertainty_seconds = seconds_since(uncertainty_start);
  return out;
}

}  // namespace bpms
