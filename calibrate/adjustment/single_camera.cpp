#include "calibrate/adjustment/single_camera.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibrate/adjustment/bundle_adjustment.h"
#include "calibrate/adjustment/view_pose.h"
#include "calibrate/lenses/enrich.h"
#include "calibrate/lenses/fisheye_start.h"
#include "core/statistics.h"

namespace bpms {
namespace {

using ViewProjections = std::map<std::pair<int, int>, ViewProjection>;

ViewProjections view_projections(const BundleProblem& problem, int camera, const Eigen::Vector2d& centre) {
  std::map<std::pair<int, int>, std::vector<PointPair>> points;
  for (const CornerObservation& corner : problem.corners) {
    if (corner.camera != camera || !corner.used) continue;
    const NetworkTarget& target = problem.targets[static_cast<std::size_t>(corner.target)];
    if (target.known == PointsKnown::unknown) continue;
    points[{corner.frame, corner.target}].push_back(
        {target.points_m[static_cast<std::size_t>(corner.point)], corner.pixel - centre});
  }
  ViewProjections out;
  for (const auto& [key, pairs] : points)
    if (const auto view = view_projection(pairs)) out[key] = *view;
  return out;
}

// The median over views, weighted by what each view knows, ignores single bad boards.
double focal_length(const ViewProjections& views, double otherwise) {
  std::vector<std::pair<double, double>> votes;  // 1/f^2, weight
  double total = 0;
  for (const auto& [key, view] : views) {
    const auto vote = focal_vote(view);
    if (!vote) continue;
    votes.emplace_back(vote->inverse_square, vote->weight);
    total += vote->weight;
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

Camera first_guess(const Observations::ObservedCamera& observed, const LensChoice& lens, double focal_px,
                   const Eigen::Vector2d& centre) {
  Camera camera;
  camera.name = observed.name;
  camera.width_px = observed.width_px;
  camera.height_px = observed.height_px;
  const LensChoice simple = lens.from.empty() ? lens : lens_choice(lens.from);
  camera.model = simple.model;
  camera.constants = simple.constants;
  camera.parameters.assign(static_cast<std::size_t>(simple.parameters), 0.0);
  std::copy_n(std::array{focal_px, focal_px, centre.x(), centre.y()}.begin(), 4, camera.parameters.begin());
  return camera;
}

// Where straight lines are curves in the image, of views that are flat.
struct WideStart {
  double focal_px = 0;
  std::map<std::pair<int, int>, Pose> poses;
};
WideStart wide_start(const BundleProblem& problem, int camera, const Observations::ObservedCamera& observed) {
  std::map<std::pair<int, int>, FlatView> views;
  for (const CornerObservation& corner : problem.corners) {
    if (corner.camera != camera || !corner.used) continue;
    FlatView& view = views[{corner.frame, corner.target}];
    view.points_m.push_back(problem.targets[static_cast<std::size_t>(corner.target)]
                                .points_m[static_cast<std::size_t>(corner.point)]);
    view.pixels.push_back(corner.pixel);
  }
  std::vector<FlatView> list;
  for (const auto& [key, view] : views) list.push_back(view);
  WideStart out{static_cast<double>(std::max(observed.width_px, observed.height_px)), {}};
  const auto start = fisheye_start(list, observed.width_px, observed.height_px);
  if (!start) return out;
  out.focal_px = start->focal_px;
  std::size_t i = 0;
  for (const auto& [key, view] : views) {
    if (start->camera_from_target[i]) out.poses[key] = *start->camera_from_target[i];
    ++i;
  }
  return out;
}

WideStart narrow_start(const ViewProjections& views, double focal_px) {
  WideStart out{focal_px, {}};
  for (const auto& [key, view] : views) out.poses[key] = camera_from_target(view, focal_px);
  return out;
}

// Every target in every frame for itself, each flat and exact: the joint solve knows better.
BundleProblem alone_of(const BundleProblem& joint, int camera,
                       const std::map<std::pair<int, int>, Pose>& views) {
  BundleProblem out = joint;
  out.rig_moves = false;
  out.table_angles.clear();
  if (static_cast<std::size_t>(camera) < joint.held.size())
    out.held = {joint.held[static_cast<std::size_t>(camera)]};
  for (NetworkTarget& target : out.targets) {
    target.stands = false;
    target.known = PointsKnown::exact;
    target.bending.clear();
  }
  std::erase_if(out.corners, [&](const CornerObservation& c) {
    return c.camera != camera || !views.contains({c.frame, c.target});
  });
  for (CornerObservation& corner : out.corners) corner.camera = 0;
  return out;
}

}  // namespace

SingleCamera single_camera(const BundleProblem& joint, int index,
                           const Observations::ObservedCamera& observed, const LensChoice& lens) {
  const Eigen::Vector2d centre(0.5 * (observed.width_px - 1), 0.5 * (observed.height_px - 1));
  const ViewProjections views = view_projections(joint, index, centre);
  const bool weak = static_cast<std::size_t>(index) < joint.held.size() &&
                    !joint.held[static_cast<std::size_t>(index)].empty();
  const WideStart start =
      lens.model == "fisheye"
          ? wide_start(joint, index, observed)
          : narrow_start(views, focal_length(views, std::max(observed.width_px, observed.height_px)));
  const double f = start.focal_px;
  BundleProblem alone = alone_of(joint, index, start.poses);
  BundleState state =
      empty_state(alone, {first_guess(observed, weak ? lens_choice("pinhole") : lens, f, centre)});
  for (const auto& [key, pose] : start.poses)
    state.world_from_target[static_cast<std::size_t>(key.second)][static_cast<std::size_t>(key.first)] = pose;
  std::erase_if(alone.corners, [&](const CornerObservation& c) { return !residual(alone, state, c); });
  SingleCamera out;
  if (!alone.corners.empty()) {
    constexpr double rough = 1e-3;  // a start for what follows
    adjust(alone, {.tolerance = rough, .most_iterations = 50}, state);
    for (int round = 0; round < 2; ++round) {
      const double sigma = robust_sigma(alone, state);
      if (sigma > 0) adjust(alone, {cauchy_sigmas * sigma, rough, 50}, state);
    }
  }
  for (const CornerObservation& corner : alone.corners)
    out.camera_from_target[{corner.frame, corner.target}] =
        rig_from_target(alone, state, corner.target, corner.frame);
  out.camera = state.cameras[0];
  if (!weak) out.camera = enriched(out.camera, lens);
  return out;
}

}  // namespace bpms
