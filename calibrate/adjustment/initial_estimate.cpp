#include "calibrate/adjustment/initial_estimate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "calibrate/adjustment/homography.h"
#include "calibrate/lenses/enrich.h"
#include "calibrate/lenses/fisheye_start.h"
#include "core/statistics.h"

namespace bpms {
namespace {

using FrameHomographies = std::map<int, Eigen::Matrix3d>;  // of one camera, onto pixels from its image centre

FrameHomographies homographies(const BundleProblem& problem, int camera, const Eigen::Vector2d& centre) {
  std::map<int, std::pair<std::vector<Eigen::Vector2d>, std::vector<Eigen::Vector2d>>> points;
  for (const CornerObservation& corner : problem.corners) {
    if (corner.camera != camera || !corner.used) continue;
    auto& [plane, image] = points[corner.frame];
    plane.push_back(problem.points_m[static_cast<std::size_t>(corner.point)].head<2>());
    image.push_back(corner.pixel - centre);
  }
  FrameHomographies out;
  for (const auto& [frame, pair] : points) {
    if (const auto h = homography(pair.first, pair.second)) out[frame] = *h;
  }
  return out;
}

// Of each view the two conditions on a rotation's columns, a (h1x h2x + h1y h2y) + h1z h2z = 0 and the same
// of |h1|^2 - |h2|^2, give a = 1/f^2; the median over views, weighted by what each view knows, ignores single
// bad boards.
double focal_length(const FrameHomographies& homographies, double otherwise) {
  std::vector<std::pair<double, double>> votes;  // a, weight
  double total = 0;
  for (const auto& [frame, h] : homographies) {
    const Eigen::Vector3d h1 = h.col(0) / h.col(0).norm(), h2 = h.col(1) / h.col(0).norm();
    const Eigen::Vector2d c(h1.head<2>().dot(h2.head<2>()),
                            h1.head<2>().squaredNorm() - h2.head<2>().squaredNorm());
    const Eigen::Vector2d d(h1.z() * h2.z(), h1.z() * h1.z() - h2.z() * h2.z());
    if (!(c.squaredNorm() > 0)) continue;
    votes.emplace_back(-c.dot(d) / c.squaredNorm(), c.squaredNorm());
    total += c.squaredNorm();
  }
  std::sort(votes.begin(), votes.end());
  double sum = 0;
  for (const auto& [a, weight] : votes) {
    sum += weight;
    if (sum < total / 2) continue;
    const double f = a > 0 ? 1 / std::sqrt(a) : 0;
    constexpr double shortest = 0.2, longest = 50;  // of the image's width
    return f > shortest * otherwise && f < longest * otherwise ? f : otherwise;
  }
  return otherwise;
}

struct WideStart {
  double focal_px = 0;
  std::map<int, Pose> poses;  // of each frame
};

WideStart wide_start(const BundleProblem& problem, int camera, const Observations::ObservedCamera& observed) {
  std::map<int, FlatView> by_frame;
  for (const CornerObservation& corner : problem.corners) {
    if (corner.camera != camera || !corner.used) continue;
    FlatView& view = by_frame[corner.frame];
    view.points_m.push_back(problem.points_m[static_cast<std::size_t>(corner.point)]);
    view.pixels.push_back(corner.pixel);
  }
  std::vector<FlatView> views;
  for (const auto& [frame, view] : by_frame) views.push_back(view);
  WideStart out{static_cast<double>(std::max(observed.width_px, observed.height_px)), {}};
  const auto start = fisheye_start(views, observed.width_px, observed.height_px);
  if (!start) return out;
  out.focal_px = start->focal_px;
  std::size_t i = 0;
  for (const auto& [frame, view] : by_frame) {
    if (start->camera_from_target[i]) out.poses[frame] = *start->camera_from_target[i];
    ++i;
  }
  return out;
}

// One camera alone, in its own frame; frames without a board in it keep an arbitrary pose and no used corner.
BundleState single_camera(const BundleProblem& joint, int index, const Observations::ObservedCamera& observed,
                          const LensChoice& lens, std::set<int>& frames) {
  const Eigen::Vector2d centre(0.5 * (observed.width_px - 1), 0.5 * (observed.height_px - 1));
  const bool wide = lens.model == "fisheye";
  const FrameHomographies planes = wide ? FrameHomographies() : homographies(joint, index, centre);
  const WideStart start = wide ? wide_start(joint, index, observed) : WideStart{};
  const double f =
      wide ? start.focal_px : focal_length(planes, std::max(observed.width_px, observed.height_px));
  BundleState state;
  Camera camera;
  camera.name = observed.name;
  camera.width_px = observed.width_px;
  camera.height_px = observed.height_px;
  const LensChoice simple = lens.from.empty() ? lens : lens_choice(lens.from);
  camera.model = simple.model;
  camera.constants = simple.constants;
  camera.parameters.assign(static_cast<std::size_t>(simple.parameters), 0.0);
  std::copy_n(std::array{f, f, centre.x(), centre.y()}.begin(), 4, camera.parameters.begin());
  state.cameras.push_back(camera);
  state.rig_from_board.resize(static_cast<std::size_t>(joint.frames));
  for (const auto& [frame, h] : planes) {
    const Eigen::Matrix3d normalised = Eigen::Vector3d(1 / f, 1 / f, 1).asDiagonal() * h;
    state.rig_from_board[static_cast<std::size_t>(frame)] = pose_from_homography(normalised);
  }
  for (const auto& [frame, pose] : start.poses) state.rig_from_board[static_cast<std::size_t>(frame)] = pose;

  BundleProblem alone = joint;
  std::erase_if(alone.corners, [&](const CornerObservation& c) {
    return c.camera != index || !(planes.contains(c.frame) || start.poses.contains(c.frame));
  });
  for (CornerObservation& corner : alone.corners) corner.camera = 0;
  std::erase_if(alone.corners, [&](const CornerObservation& c) { return !residual(alone, state, c); });
  for (const CornerObservation& corner : alone.corners) frames.insert(corner.frame);
  if (alone.corners.empty()) return state;
  alone.free_bending = false;     // the joint solve knows it better
  constexpr double rough = 1e-3;  // a start for what follows
  adjust(alone, {.tolerance = rough, .most_iterations = 50}, state);
  for (int round = 0; round < 2; ++round) {
    const double sigma = robust_sigma(alone, state);
    if (sigma > 0) adjust(alone, {cauchy_sigmas * sigma, rough, 50}, state);
  }
  state.cameras[0] = enriched(state.cameras[0], lens);
  return state;
}

double distance(const Pose& a, const Pose& b, double metres_per_radian) {
  return (a.t_m - b.t_m).norm() + metres_per_radian * vector_from_rotation(a.r * b.r.transpose()).norm();
}

// The candidate with the least median distance to the others.
Pose medoid(const std::vector<Pose>& candidates) {
  double size = 0;
  for (const Pose& pose : candidates) size = std::max(size, pose.t_m.norm());
  std::size_t best = 0;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::vector<double> distances;
    for (const Pose& other : candidates) distances.push_back(distance(candidates[i], other, size));
    const double middle = median(std::move(distances));
    if (middle < least) least = middle, best = i;
  }
  return candidates[best];
}

// Each frame's board from the camera whose view of it suits the other views best: a view found wrongly must
// not place the board for all.
void place_boards(const BundleProblem& problem, const std::vector<BundleState>& alone,
                  const std::vector<std::set<int>>& frames, BundleState& joint) {
  const auto count = static_cast<std::size_t>(problem.frames);
  joint.rig_from_board.resize(count);
  std::vector<std::vector<CornerObservation>> corners(count);
  for (const CornerObservation& corner : problem.corners)
    corners[static_cast<std::size_t>(corner.frame)].push_back(corner);
  std::vector<double> least(count, HUGE_VAL);
  for (std::size_t c = 0; c < alone.size(); ++c) {
    const Pose rig_from_cam =
        Pose{joint.cameras[c].r_cam_from_rig, joint.cameras[c].t_cam_from_rig_m}.inverse();
    for (const int frame : frames[c]) {
      const auto f = static_cast<std::size_t>(frame);
      const Pose before = joint.rig_from_board[f];
      joint.rig_from_board[f] = rig_from_cam * alone[c].rig_from_board[f];
      double cost = 0;
      for (const CornerObservation& corner : corners[f]) {
        const auto r = residual(problem, joint, corner);
        constexpr double nowhere_px = 1e4;
        cost += std::log1p(r ? r->squaredNorm() : nowhere_px * nowhere_px);  // Cauchy's loss at 1 px
      }
      if (cost < least[f])
        least[f] = cost;
      else
        joint.rig_from_board[f] = before;
    }
  }
}

}  // namespace

BundleState initial_estimate(const BundleProblem& problem,
                             const std::vector<Observations::ObservedCamera>& cameras,
                             const LensChoice& lens) {
  const std::size_t n = cameras.size();
  std::vector<BundleState> alone;
  std::vector<std::set<int>> frames(n);
  BundleState joint;
  for (std::size_t c = 0; c < n; ++c) {
    alone.push_back(single_camera(problem, static_cast<int>(c), cameras[c], lens, frames[c]));
    joint.cameras.push_back(alone[c].cameras[0]);
  }
  std::vector<bool> joined(n, false);
  joined[0] = true;
  for (std::size_t step = 1; step < n; ++step) {  // the pair with the most shared frames next
    std::size_t from = 0, to = 0;
    std::vector<int> shared;
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        if (!joined[a] || joined[b]) continue;
        std::vector<int> both;
        std::set_intersection(frames[a].begin(), frames[a].end(), frames[b].begin(), frames[b].end(),
                              std::back_inserter(both));
        if (both.size() > shared.size()) shared = both, from = a, to = b;
      }
    }
    if (shared.empty()) {
      const auto lonely =
          static_cast<std::size_t>(std::find(joined.begin(), joined.end(), false) - joined.begin());
      bad_input(
          {},
          "camera {} shares no frame with {}: the cameras' images of one moment must carry the same digits",
          in_quotes(cameras[lonely].name), in_quotes(cameras[0].name));
    }
    std::vector<Pose> candidates;
    for (const int frame : shared) {
      const auto f = static_cast<std::size_t>(frame);
      candidates.push_back(alone[to].rig_from_board[f] * alone[from].rig_from_board[f].inverse());
    }
    const Pose relative = medoid(candidates);
    Camera& camera = joint.cameras[to];
    const Camera& base = joint.cameras[from];
    const Pose pose = relative * Pose{base.r_cam_from_rig, base.t_cam_from_rig_m};
    camera.r_cam_from_rig = pose.r;
    camera.t_cam_from_rig_m = pose.t_m;
    joined[to] = true;
  }
  place_boards(problem, alone, frames, joint);
  return joint;
}

}  // namespace bpms
