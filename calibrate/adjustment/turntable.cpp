#include "calibrate/adjustment/turntable.h"

#include <Eigen/Dense>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/units.h"

namespace bpms {
namespace {

// A frame of the table: z along the axis, the origin on it.
Pose frame_of_axis(const Eigen::Vector3d& direction, const Eigen::Vector3d& point) {
  Eigen::Matrix3d r;
  r.col(2) = direction;
  r.col(0) = direction.unitOrthogonal();
  r.col(1) = direction.cross(r.col(0));
  return {r, point};
}

Eigen::Vector3d nearest_to_origin(const Eigen::Vector3d& direction, const Eigen::Vector3d& point) {
  return point - direction * direction.dot(point);
}

}  // namespace

BundleProblem standing(const BundleProblem& problem) {
  BundleProblem out = problem;
  out.rig_moves = false;
  out.table_angles.clear();
  for (NetworkTarget& target : out.targets) target.stands = false;
  return out;
}

// Between two frames the target turns by their angles' difference about the axis: the turns give its
// direction, and (1 - R) c = t the point that stays.
BundleState on_turntable(const BundleProblem& problem, const BundleProblem& without,
                         const BundleState& held) {
  std::set<int> seen;
  for (const CornerObservation& corner : without.corners)
    if (corner.placed && corner.target == problem.datum) seen.insert(corner.frame);
  const std::vector<int> frames(seen.begin(), seen.end());
  Eigen::Vector3d direction = Eigen::Vector3d::Zero(), right = Eigen::Vector3d::Zero();
  Eigen::Matrix3d left = Eigen::Matrix3d::Zero();
  double turned = 0;
  const auto pose = [&](int f) { return rig_from_target(without, held, problem.datum, f); };
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (std::size_t j = i + 1; j < frames.size(); ++j) {
      const double angle = std::remainder(problem.table_angles[static_cast<std::size_t>(frames[j])] -
                                              problem.table_angles[static_cast<std::size_t>(frames[i])],
                                          2 * pi);
      constexpr double most = 2.5;  // near half a turn the sign of the rotation vector is chance
      if (std::abs(angle) > most) continue;
      const Pose step = pose(frames[j]) * pose(frames[i]).inverse();
      direction += angle * vector_from_rotation(step.r);
      const Eigen::Matrix3d stays = Eigen::Matrix3d::Identity() - step.r;
      left += stays.transpose() * stays;
      right += stays.transpose() * step.t_m;
      turned = std::max(turned, std::abs(angle));
    }
  }
  constexpr double least = 0.05;
  if (!(turned > least) || !(direction.norm() > 0))
    fail(ErrorKind::numeric, {}, "the frames turn by less than {} rad: they do not tell the turntable's axis",
         least);
  direction.normalize();
  // The point is free along the axis: the one nearest to the origin.
  left += left.trace() * direction * direction.transpose();
  BundleState out = empty_state(problem, held.cameras);
  out.rig_from_world[0] = frame_of_axis(direction, nearest_to_origin(direction, left.ldlt().solve(right)));
  out.bending_m = held.bending_m;
  for (int t = 0; t < static_cast<int>(problem.targets.size()); ++t) {
    for (const CornerObservation& corner : without.corners) {
      if (!corner.placed || corner.target != t) continue;
      out.world_from_target[static_cast<std::size_t>(t)][0] =
          (out.rig_from_world[0] * table_turn(problem, corner.frame)).inverse() *
          rig_from_target(without, held, t, corner.frame);
      break;
    }
  }
  return out;
}

BundleState first_state(BundleProblem& problem, const std::vector<Observations::ObservedCamera>& cameras,
                        const LensChoice& lens) {
  if (!problem.turntable()) return initial_estimate(problem, cameras, lens);
  BundleProblem held = standing(problem);
  const BundleState state = initial_estimate(held, cameras, lens);
  for (std::size_t i = 0; i < problem.corners.size(); ++i) problem.corners[i].placed = held.corners[i].placed;
  return on_turntable(problem, held, state);
}

TurntableAxis turntable_axis(const Pose& rig_from_table) {
  const Eigen::Vector3d direction = rig_from_table.r.col(2);
  return {direction, nearest_to_origin(direction, rig_from_table.t_m)};
}

Eigen::Matrix<double, 6, 6> axis_derivatives(const Pose& rig_from_table) {
  const Eigen::Vector3d a = rig_from_table.r.col(2), t = rig_from_table.t_m;
  const Eigen::Matrix3d by_turn = -cross_matrix(a);  // da = w x a
  Eigen::Matrix<double, 6, 6> out = Eigen::Matrix<double, 6, 6>::Zero();
  out.topLeftCorner<3, 3>() = by_turn;
  out.bottomLeftCorner<3, 3>() = -(a.dot(t) * Eigen::Matrix3d::Identity() + a * t.transpose()) * by_turn;
  out.bottomRightCorner<3, 3>() = Eigen::Matrix3d::Identity() - a * a.transpose();
  return out;
}

}  // namespace bpms
