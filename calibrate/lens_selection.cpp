#include "calibrate/lens_selection.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "calibrate/lenses/fisheye_start.h"
#include "calibrate/lenses/lens.h"
#include "calibrate/network_problem.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "core/text.h"

namespace bpms {
namespace {

struct SeenCorner {
  int target = 0;
  int camera = 0;
  Eigen::Vector3d on_target;
  Eigen::Vector2d pixel;
};

// Which corners no model wants.
using CornerNames = std::set<std::pair<std::string, int>>;

// As bent, or as placed, as the solve without the frame found them.
std::vector<std::vector<Eigen::Vector3d>> solved_points(const std::vector<Target>& targets,
                                                        const Calibration& solved) {
  std::vector<std::vector<Eigen::Vector3d>> out;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const Calibration::TargetResult& result = solved.targets[t];
    out.push_back(result.points_m.empty() ? targets[t].points_m() : result.points_m);
    const std::vector<Eigen::Vector2d> bending = targets[t].bending();
    for (std::size_t i = 0; i < bending.size(); ++i) out.back()[i].z() += bending[i].dot(result.warp_m);
  }
  return out;
}

// Of one frame.
std::vector<SeenCorner> corners_of_frame(const Observations& observations, const std::vector<Target>& targets,
                                         const Calibration& solved, const std::string& frame,
                                         const CornerNames& unwanted) {
  const auto points = solved_points(targets, solved);
  std::vector<SeenCorner> out;
  for (const BoardView& view : observations.views) {
    if (view.frame != frame) continue;
    for (const ImageCorner& corner : view.corners) {
      if (unwanted.contains({view.image, corner.point})) continue;
      out.push_back({view.target, view.camera,
                     points[static_cast<std::size_t>(view.target)][static_cast<std::size_t>(corner.point)],
                     corner.pixel});
    }
  }
  return out;
}

// From the rays of the camera with most corners.
std::optional<Pose> pose_start(const std::vector<Camera>& cameras, const std::vector<SeenCorner>& corners) {
  std::map<int, std::pair<std::vector<Eigen::Vector2d>, std::vector<Eigen::Vector3d>>> by_camera;
  for (const SeenCorner& corner : corners) {
    const auto ray = unproject(cameras[static_cast<std::size_t>(corner.camera)], corner.pixel);
    if (!ray) continue;
    by_camera[corner.camera].first.push_back(corner.on_target.head<2>());
    by_camera[corner.camera].second.push_back(*ray);
  }
  std::size_t most = 0;
  std::optional<Pose> out;
  for (const auto& [c, pairs] : by_camera) {
    if (pairs.first.size() <= most) continue;
    const auto pose = pose_from_rays(pairs.first, pairs.second);
    if (!pose) continue;
    const Camera& camera = cameras[static_cast<std::size_t>(c)];
    most = pairs.first.size();
    out = Pose{camera.r_cam_from_rig, camera.t_cam_from_rig_m}.inverse() * *pose;
  }
  return out;
}

struct PoseStep {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
  double cost = 0;
};

std::optional<PoseStep> pose_step(const std::vector<Camera>& cameras, const std::vector<SeenCorner>& corners,
                                  const Pose& pose) {
  PoseStep out;
  for (const SeenCorner& corner : corners) {
    const Eigen::Vector3d turned = pose.r * corner.on_target;
    const auto at =
        project_with_derivatives(cameras[static_cast<std::size_t>(corner.camera)], turned + pose.t_m);
    if (!at) return std::nullopt;
    Eigen::Matrix<double, 2, 6> j;
    j << -at->by_point * cross_matrix(turned), at->by_point;
    const Eigen::Vector2d r = corner.pixel - at->pixel;
    out.normal += j.transpose() * j;
    out.gradient += j.transpose() * r;
    out.cost += r.squaredNorm();
  }
  return out;
}

// Least squares with the cameras fixed.
std::optional<Pose> fitted_pose(const std::vector<Camera>& cameras, const std::vector<SeenCorner>& corners) {
  auto pose = pose_start(cameras, corners);
  auto at = pose ? pose_step(cameras, corners, *pose) : std::nullopt;
  if (!at) return std::nullopt;
  double damping = 1e-6;
  constexpr int most_steps = 60;
  for (int step = 0; step < most_steps; ++step) {
    Eigen::Matrix<double, 6, 6> damped = at->normal;
    damped.diagonal() *= 1 + damping;
    const Eigen::Matrix<double, 6, 1> change = damped.ldlt().solve(at->gradient);
    const Pose trial{rotation_from_vector(change.head<3>()) * pose->r, pose->t_m + change.tail<3>()};
    const auto there = pose_step(cameras, corners, trial);
    constexpr double most_damping = 1e8, factor = 10, enough = 1e-12;
    if (there && there->cost < at->cost) {
      const bool done = at->cost - there->cost < enough * at->cost;
      pose = trial, at = there, damping /= factor;
      if (done) break;
    } else if ((damping *= factor) > most_damping) {
      break;
    }
  }
  return pose;
}

struct Predicted {
  double squares = 0;
  int coordinates = 0;
};

// A corner that the model puts nowhere is as far off as the image is wide.
Predicted predict(const std::vector<Camera>& cameras, const std::vector<SeenCorner>& all) {
  std::map<int, std::array<std::vector<SeenCorner>, 2>> targets;
  for (std::size_t i = 0; i < all.size(); ++i) targets[all[i].target][i % 2].push_back(all[i]);
  Predicted out;
  for (const auto& [target, halves] : targets)
    for (std::size_t half = 0; half < 2; ++half) {
      const auto pose = fitted_pose(cameras, halves[half]);
      for (const SeenCorner& corner : halves[1 - half]) {
        const Camera& camera = cameras[static_cast<std::size_t>(corner.camera)];
        const auto pixel =
            pose ? project(camera, camera.camera_from_rig(*pose * corner.on_target)) : std::nullopt;
        out.squares += pixel ? (corner.pixel - *pixel).squaredNorm() : std::pow(camera.width_px, 2);
        out.coordinates += 2;
      }
    }
  return out;
}

Observations without(const Observations& observations, const std::set<std::string>& frames) {
  Observations out = observations;
  std::erase_if(out.views, [&](const BoardView& view) { return frames.contains(view.frame); });
  return out;
}

// What each frame's corners are predicted like, in the order of `frames`.
std::vector<Predicted> cross_validate(const Observations& observations, const std::vector<Target>& targets,
                                      const CalibrateOptions& options, const std::vector<std::string>& frames,
                                      int folds, const CornerNames& unwanted) {
  std::vector<Predicted> out(frames.size());
  const auto count = static_cast<std::size_t>(folds);
  parallel_for(count, [&](std::size_t fold) {
    throw_if_interrupted();
    std::set<std::string> left_out;
    for (std::size_t f = fold; f < frames.size(); f += count) left_out.insert(frames[f]);
    const Calibration solved = calibrate(without(observations, left_out), targets, options);
    for (std::size_t f = fold; f < frames.size(); f += count)
      out[f] =
          predict(solved.rig.cameras, corners_of_frame(observations, targets, solved, frames[f], unwanted));
  });
  return out;
}

struct Candidate {
  CalibrateOptions options;
  std::optional<Calibration> all;
  std::vector<Predicted> frames;
};

// Runs what a model that does not suit the images may fail at; says why it failed.
template <class Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numeric && error.kind() != ErrorKind::bad_input) throw;
    return error.message();
  }
  return {};
}

int free_parameters(const Camera& camera) {
  const auto held = find_lens(camera.model)->held({camera.parameters, camera.constants});
  return static_cast<int>(camera.parameters.size() - held.size());
}

CornerNames wanted_by_none(const std::vector<Candidate>& candidates) {
  std::map<std::pair<std::string, int>, std::size_t> votes;
  std::size_t models = 0;
  for (const Candidate& candidate : candidates) {
    if (!candidate.all) continue;
    ++models;
    for (const auto& outlier : candidate.all->outliers) ++votes[{outlier.image, outlier.corner}];
  }
  CornerNames out;
  for (const auto& [name, count] : votes)
    if (count == models) out.insert(name);
  return out;
}

// Mean over all coordinates of a - b, and its standard error from the scatter of the frames.
std::pair<double, double> mean_difference(const std::vector<Predicted>& a, const std::vector<Predicted>* b) {
  double sum = 0, count = 0;
  for (std::size_t f = 0; f < a.size(); ++f) {
    sum += a[f].squares - (b ? (*b)[f].squares : 0);
    count += a[f].coordinates;
  }
  const double mean = sum / count;
  double scatter = 0;
  for (std::size_t f = 0; f < a.size(); ++f)
    scatter += std::pow(a[f].squares - (b ? (*b)[f].squares : 0) - mean * a[f].coordinates, 2);
  const double n = static_cast<double>(a.size());
  return {mean, std::sqrt(scatter * n / (n - 1)) / count};
}

void judge(const std::vector<Candidate>& candidates, LensSelection& out) {
  std::size_t best = candidates.size();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    LensScore& score = out.scores[i];
    if (!score.refused.empty()) continue;
    const auto [mean, error] = mean_difference(candidates[i].frames, nullptr);
    score.predicted_rms_px = std::sqrt(mean);
    score.predicted_se_px = mean > 0 ? error / (2 * std::sqrt(mean)) : 0;
    if (best == candidates.size() || score.predicted_rms_px < out.scores[best].predicted_rms_px) best = i;
  }
  if (best == candidates.size())
    fail(ErrorKind::numeric, {}, "no lens model suits the images; {}: {}", out.scores.front().lens,
         out.scores.front().refused);
  LensScore* chosen = nullptr;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    LensScore& score = out.scores[i];
    if (!score.refused.empty()) continue;
    std::tie(score.worse_px2, score.worse_se_px2) =
        mean_difference(candidates[i].frames, &candidates[best].frames);
    if (score.worse_px2 <= score.worse_se_px2 && (!chosen || score.parameters < chosen->parameters))
      chosen = &score;
  }
  chosen->chosen = true;
  out.chosen = chosen->lens;
}

}  // namespace

LensSelection choose_lens(const Observations& observations, const std::vector<Target>& targets,
                          const LensSelectionOptions& options) {
  const std::vector<std::string> frames = frame_names(observations);
  constexpr std::size_t fewest_frames = 4;
  if (frames.size() < fewest_frames)
    bad_input({}, "{} frames cannot choose a lens model, at least {} are needed: name one with --model",
              frames.size(), fewest_frames);
  LensSelection out;
  out.frames = static_cast<int>(frames.size());
  out.folds = std::clamp(options.folds, 2, out.frames);
  std::vector<Candidate> candidates(options.candidates.size());
  out.scores.resize(candidates.size());
  parallel_for(candidates.size(), [&](std::size_t i) {
    throw_if_interrupted();
    Candidate& candidate = candidates[i];
    LensScore& score = out.scores[i];
    candidate.options = options.calibrate;
    candidate.options.lens = score.lens = options.candidates[i];
    candidate.options.uncertainty = false;
    score.refused = refusal([&] { candidate.all = calibrate(observations, targets, candidate.options); });
    if (!candidate.all) return;
    score.parameters = free_parameters(candidate.all->rig.cameras.front());
    score.in_sample_rms_px = candidate.all->residual_rms_px;
  });
  const CornerNames unwanted = wanted_by_none(candidates);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Candidate& candidate = candidates[i];
    if (!candidate.all) continue;
    out.scores[i].refused = refusal([&] {
      candidate.frames =
          cross_validate(observations, targets, candidate.options, frames, out.folds, unwanted);
    });
    if (!out.scores[i].refused.empty())
      out.scores[i].refused = "without a fold of frames: " + out.scores[i].refused;
  }
  for (const BoardView& view : observations.views)
    for (const ImageCorner& corner : view.corners)
      out.corners += unwanted.contains({view.image, corner.point}) ? 0 : 1;
  judge(candidates, out);
  return out;
}

}  // namespace bpms
