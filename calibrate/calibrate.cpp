#include "calibrate/calibrate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "calibrate/adjustment/initial_estimate.h"
#include "calibrate/adjustment/outliers.h"
#include "calibrate/adjustment/uncertainty.h"
#include "core/text.h"

namespace bpms {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Frames in order of their numbers, "9" before "10".
std::vector<std::string> frame_names(const Observations& observations) {
  std::set<std::pair<long long, std::string>> sorted;
  for (const BoardView& view : observations.views)
    sorted.emplace(parse_integer(view.frame).value_or(0), view.frame);
  std::vector<std::string> out;
  for (const auto& [number, name] : sorted) out.push_back(name);
  return out;
}

// "; skipped left3.png: no whole chessboard found", the first few.
std::string skipped_words(const Observations& observations) {
  constexpr std::size_t most = 3;
  std::string out;
  const auto& skipped = observations.skipped;
  for (std::size_t i = 0; i < std::min(most, skipped.size()); ++i)
    out += fmt::format("; skipped {}: {}", skipped[i].image, skipped[i].reason);
  if (skipped.size() > most) out += fmt::format("; and {} more", skipped.size() - most);
  return out;
}

void require_views(const Observations& observations) {
  constexpr int fewest = 3;
  if (observations.views.empty()) {
    const auto& skipped = observations.skipped;
    if (skipped.empty()) bad_input({}, "no usable view of the target");
    bad_input({}, "no usable view of the target among {} images; the first, {}: {}", skipped.size(),
              skipped.front().image, skipped.front().reason);
  }
  for (std::size_t c = 0; c < observations.cameras.size(); ++c) {
    const auto views =
        std::count_if(observations.views.begin(), observations.views.end(),
                      [&](const BoardView& view) { return view.camera == static_cast<int>(c); });
    if (views < fewest)
      bad_input({}, "camera {} has {} usable view{} of the target, at least {} are needed{}",
                in_quotes(observations.cameras[c].name), views, views == 1 ? "" : "s", fewest,
                skipped_words(observations));
  }
}

BundleProblem make_problem(const Observations& observations, const Target& target,
                           const std::vector<std::string>& frames, bool board_warp) {
  BundleProblem out;
  out.points_m = target.points_m();
  out.bending = target.bending();
  out.free_bending = board_warp;
  out.frames = static_cast<int>(frames.size());
  for (std::size_t v = 0; v < observations.views.size(); ++v) {
    const BoardView& view = observations.views[v];
    const auto frame = std::find(frames.begin(), frames.end(), view.frame) - frames.begin();
    for (const ImageCorner& corner : view.corners) {
      if (corner.point < 0 || corner.point >= target.size())
        bad_input({view.image}, "corner {} is not on the target", corner.point);
      out.corners.push_back(
          {static_cast<int>(v), static_cast<int>(frame), view.camera, corner.point, corner.pixel});
    }
  }
  return out;
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

void require_sound_lenses(const std::vector<Camera>& cameras) {
  for (const Camera& camera : cameras) {
    if (!(camera.parameters[0] > 0) || !(camera.parameters[1] > 0))
      fail(ErrorKind::numeric, {},
           "camera {} came out with focal lengths {:.6g}, {:.6g}: the views do not suit the model",
           in_quotes(camera.name), camera.parameters[0], camera.parameters[1]);
    if (const auto pixel = pixel_without_ray(camera))
      fail(ErrorKind::numeric, {},
           "the distortion of camera {} folds or has a pole inside the image, near pixel ({:.0f}, {:.0f}): "
           "ask for fewer "
           "lens parameters, or show the target near the image's edges",
           in_quotes(camera.name), pixel->x(), pixel->y());
  }
}

void describe_views(const Observations& observations, const BundleProblem& problem, const BundleState& state,
                    const OutlierSearch& search, Calibration& out) {
  std::vector<int> left_out(observations.views.size(), 0);
  for (std::size_t v = 0; v < observations.views.size(); ++v) {
    const BoardView& view = observations.views[v];
    out.views.push_back({view.image,
                         observations.cameras[static_cast<std::size_t>(view.camera)].name,
                         view.frame,
                         search.view_rms_px[v],
                         search.view_out[v],
                         {},
                         {}});
  }
  for (const CornerObservation& corner : problem.corners) {
    const auto v = static_cast<std::size_t>(corner.view);
    const auto r = residual(problem, state, corner);
    ++out.corners_total;
    if (corner.used) {
      ++out.corners_used;
      out.views[v].residuals.emplace_back(corner.pixel.x(), corner.pixel.y(), r->x(), r->y());
    } else {
      ++left_out[v];
      out.outliers.push_back({out.views[v].image, corner.point, r ? r->norm() : NAN});
    }
  }
  for (std::size_t v = 0; v < out.views.size(); ++v) {
    if (!out.views[v].outlier) continue;
    out.views[v].reason = fmt::format(
        "residual rms {:.3g} px against {:.3g} px of the used corners; {} of {} corners left out",
        out.views[v].rms_px, out.residual_rms_px, left_out[v], observations.views[v].corners.size());
  }
}

// The clustered covariance has the rank of the frames, often fewer than the parameters: the file gets the iid
// correlations with the clustered sigmas, which is positive definite and honest on the diagonal.
Rig::Covariance rig_covariance(const NormalEquations& equations, const Eigen::MatrixXd& cofactors,
                               const Eigen::VectorXd& sigma_iid, const Eigen::VectorXd& sigma,
                               const std::string& kind) {
  const auto n = static_cast<Eigen::Index>(equations.order.size());
  const Eigen::VectorXd scale = (sigma_iid.array() > 0).select(sigma.cwiseQuotient(sigma_iid), 0.0);
  const double variance = std::pow(equations.sigma_px(), 2);
  Eigen::MatrixXd matrix =
      scale.asDiagonal() * (variance * cofactors.topLeftCorner(n, n)) * scale.asDiagonal();
  matrix = 0.5 * (matrix + matrix.transpose().eval());
  return {equations.order, matrix, kind};
}

// Odd and even frame numbers; first, third, ... against the others where the numbers leave a half too small.
std::vector<bool> odd_frames(const std::vector<std::string>& frames) {
  std::vector<bool> odd;
  for (const std::string& name : frames) odd.push_back(parse_integer(name).value_or(0) % 2 != 0);
  const auto count = std::count(odd.begin(), odd.end(), true), all = static_cast<std::ptrdiff_t>(odd.size());
  if (std::min(count, all - count) >= all / 3) return odd;
  for (std::size_t i = 0; i < odd.size(); ++i) odd[i] = i % 2 == 0;
  return odd;
}

struct Half {
  double baseline_m = 0;
  double sigma_m = 0;
};
Half half_set(const BundleProblem& problem, const BundleState& solution, const std::vector<bool>& keep) {
  BundleProblem half = problem;
  std::erase_if(half.corners,
                [&](const CornerObservation& c) { return !keep[static_cast<std::size_t>(c.frame)]; });
  const BundleState state = solve_subset(half, solution, keep);
  const NormalEquations equations = normal_equations(half, state);
  const Clustered clustered = clustered_by_frame(half, state, equations, cofactors(equations), {{0, 1}});
  return {relative_pose(state.cameras, 0, 1).t_m.norm(), clustered.baseline_sigma_m[0]};
}

void add_half_sets(const BundleProblem& problem, const BundleState& state,
                   const std::vector<std::string>& frames, Calibration& out) {
  std::vector<bool> keep = odd_frames(frames);
  try {
    const Half odd = half_set(problem, state, keep);
    keep.flip();
    const Half even = half_set(problem, state, keep);
    out.half_sets = {odd.baseline_m, even.baseline_m, std::hypot(odd.sigma_m, even.sigma_m)};
  } catch (const Error& error) {  // too few frames for halves: the report has none
    if (error.kind() != ErrorKind::numeric) throw;
  }
}

std::vector<CameraPair> all_pairs(std::size_t cameras) {
  std::vector<CameraPair> out;
  for (int a = 0; a < static_cast<int>(cameras); ++a) {
    for (int b = a + 1; b < static_cast<int>(cameras); ++b) out.push_back({a, b});
  }
  return out;
}

}  // namespace

std::optional<Eigen::Vector2d> pixel_without_ray(const Camera& camera) {
  constexpr int steps = 16;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const Eigen::Vector2d pixel((camera.width_px - 1) * i / static_cast<double>(steps),
                                  (camera.height_px - 1) * j / static_cast<double>(steps));
      if (!unproject(camera, pixel)) return pixel;
    }
  }
  return std::nullopt;
}

Calibration calibrate(const Observations& observations, const Target& target,
                      const CalibrateOptions& options) {
  const Clock::time_point start = Clock::now();
  require_views(observations);
  const std::vector<std::string> frames = frame_names(observations);
  BundleProblem problem = make_problem(observations, target, frames, options.board_warp);
  BundleState state = initial_estimate(problem, observations.cameras, lens_choice(options.lens));
  const OutlierSearch search =
      fit_without_outliers(problem, static_cast<int>(observations.views.size()), state);
  const NormalEquations equations = normal_equations(problem, state);
  if (equations.observations <= equations.parameters)
    fail(ErrorKind::numeric, {}, "{} coordinates cannot determine {} parameters", equations.observations,
         equations.parameters);
  require_sound_lenses(state.cameras);
  const Eigen::MatrixXd inverse = cofactors(equations);
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
  out.board_warp_m = state.bending_m;
  describe_views(observations, problem, state, search, out);
  const auto n = static_cast<Eigen::Index>(equations.order.size());
  out.sigma_iid = equations.sigma_px() * inverse.diagonal().head(n).cwiseSqrt();
  const std::vector<CameraPair> pairs = all_pairs(state.cameras.size());
  for (const CameraPair& pair : pairs) {
    const Pose pose = relative_pose(state.cameras, pair.a, pair.b);
    const Eigen::VectorXd gradient = baseline_gradient(state.cameras, pair.a, pair.b, inverse.rows());
    out.pairs.push_back({pair.a, pair.b, pose.t_m.norm(),
                         equations.sigma_px() * std::sqrt(gradient.dot(inverse * gradient)), std::nullopt,
                         vector_from_rotation(pose.r), pose.t_m});
  }
  out.solve_seconds = seconds_since(start);

  const Clock::time_point uncertainty_start = Clock::now();
  if (options.uncertainty) {
    try {
      const Clustered clustered = clustered_by_frame(problem, state, equations, inverse, pairs);
      out.sigma_clustered = clustered.sigma;
      for (std::size_t i = 0; i < pairs.size(); ++i)
        out.pairs[i].baseline_sigma_clustered_m = clustered.baseline_sigma_m[i];
      if (state.cameras.size() > 1) add_half_sets(problem, state, frames, out);
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
  out.uncertainty_seconds = seconds_since(uncertainty_start);
  return out;
}

}  // namespace bpms
