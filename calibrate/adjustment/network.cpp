#include "calibrate/adjustment/network.h"

#include <algorithm>
#include <cmath>

#include "calibrate/lenses/lens.h"
#include "core/statistics.h"

namespace bpms {

BundleState empty_state(const BundleProblem& problem, std::vector<Camera> cameras) {
  BundleState out;
  out.cameras = std::move(cameras);
  if (problem.rig_moves)
    out.rig_from_world.resize(problem.turntable() ? 1 : static_cast<std::size_t>(problem.frames));
  for (int t = 0; t < static_cast<int>(problem.targets.size()); ++t) {
    const NetworkTarget& target = problem.targets[static_cast<std::size_t>(t)];
    out.world_from_target.emplace_back(problem.slots(t));
    out.bending_m.emplace_back(0, 0);
    out.shifts_m.emplace_back(target.known == PointsKnown::exact ? 0 : target.points_m.size(),
                              Eigen::Vector3d::Zero());
  }
  return out;
}

std::vector<std::size_t> BundleProblem::free_parameters(int index, const Camera& camera) const {
  std::vector<int> fixed = find_lens(camera.model)->held({camera.parameters, camera.constants});
  const auto c = static_cast<std::size_t>(index);
  if (c < held.size()) fixed.insert(fixed.end(), held[c].begin(), held[c].end());
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < camera.parameters.size(); ++i)
    if (std::find(fixed.begin(), fixed.end(), static_cast<int>(i)) == fixed.end()) out.push_back(i);
  return out;
}

Pose camera_pose(const Camera& camera) {
  return {camera.r_cam_from_rig, camera.t_cam_from_rig_m};
}

void set_pose(Camera& camera, const Pose& pose) {
  camera.r_cam_from_rig = pose.r;
  camera.t_cam_from_rig_m = pose.t_m;
}

Pose table_turn(const BundleProblem& problem, int frame) {
  if (!problem.turntable()) return {};
  return {rotation_from_vector({0, 0, problem.table_angles[static_cast<std::size_t>(frame)]}),
          Eigen::Vector3d::Zero()};
}

Pose rig_from_target(const BundleProblem& problem, const BundleState& state, int target, int frame) {
  const Pose& place = state.world_from_target[static_cast<std::size_t>(target)][problem.slot(target, frame)];
  return problem.rig_moves
             ? state.rig_from_world[problem.rig_slot(frame)] * table_turn(problem, frame) * place
             : place;
}

Eigen::Vector3d target_point(const BundleProblem& problem, const BundleState& state, int target, int point) {
  const auto t = static_cast<std::size_t>(target), i = static_cast<std::size_t>(point);
  const NetworkTarget& what = problem.targets[t];
  Eigen::Vector3d out = what.points_m[i];
  if (!what.bending.empty()) out.z() += what.bending[i].dot(state.bending_m[t]);
  if (!state.shifts_m[t].empty()) out += state.shifts_m[t][i];
  return out;
}

std::optional<Eigen::Vector2d> residual(const BundleProblem& problem, const BundleState& state,
                                        const CornerObservation& corner) {
  const Camera& camera = state.cameras[static_cast<std::size_t>(corner.camera)];
  const Pose place = rig_from_target(problem, state, corner.target, corner.frame);
  const auto pixel = project(
      camera, camera.camera_from_rig(place * target_point(problem, state, corner.target, corner.point)));
  if (!pixel) return std::nullopt;
  return corner.pixel - *pixel;
}

double robust_sigma(const BundleProblem& problem, const BundleState& state) {
  std::vector<double> sizes;
  for (const CornerObservation& corner : problem.corners) {
    if (!corner.used) continue;
    const auto r = residual(problem, state, corner);
    for (int axis = 0; axis < 2; ++axis) sizes.push_back(r ? std::abs((*r)[axis]) : HUGE_VAL);
  }
  if (sizes.empty()) return 0;
  constexpr double median_of_half_normal = 0.6745;
  return median(std::move(sizes)) / median_of_half_normal;
}

}  // namespace bpms
