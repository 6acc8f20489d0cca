// What an adjustment is told and what it moves: cameras fixed to a rig, targets that stand or are held anew
// in each frame, and the corners seen. Chain of frames: X_cam = C_camera R_frame T_target X_target. The rig
// may stand (R is the identity, the world is the rig's frame) or move through a world in which a target, the
// datum, stands at the origin; or the world turns on a turntable before a rig that stands. The rig's frame is
// camera 0's.
#pragma once
#include <optional>
#include <vector>

#include "calibrate/pose.h"
#include "calibrate/rig.h"
#include "calibrate/targets/target.h"

namespace bpms {

enum class PointsKnown {
  exact,
  surveyed,  // with a covariance
  free,    // estimated; together they keep the place of their nominal coordinates (inner constraints, Meissl
           // 1969), and their size too where no scale bar gives it
  unknown  // estimated, nothing is known of them: points of nature
};

struct NetworkTarget {
  std::string name;
  std::vector<Eigen::Vector3d> points_m;
  // Of each point of a board, see Target::bending(): z += w0 b0 + w1 b1. Empty: it does not bend.
  std::vector<Eigen::Vector2d> bending;
  bool stands = false;
  PointsKnown known = PointsKnown::exact;
  std::vector<Eigen::Matrix3d> covariance_m2;  // surveyed
  std::vector<ScaleBar> bars;                  // count where points are estimated
};

struct CornerObservation {
  int view = 0;
  int frame = 0;
  int camera = 0;
  int target = 0;
  int point = 0;
  Eigen::Vector2d pixel;
  bool used = true;
  bool placed = true;  // false: nothing ties its frame to the rest
};

struct BundleProblem {
  std::vector<NetworkTarget> targets;
  bool rig_moves = false;
  int datum = 0;  // of a rig that moves: a target that stands
  // Of each frame, radians about the world's z; empty: there is no turntable. rig_moves is set too, and the
  // one pose of the rig is that of the table at angle 0. The datum keeps no place but its turn about z and
  // its height.
  std::vector<double> table_angles;
  int frames = 0;
  std::vector<CornerObservation> corners;
  bool free_lenses = true, free_camera_poses = true;
  std::vector<std::vector<int>>
      held;               // of each camera's lens: parameters that are not estimated; empty: none
  double sigma_px = 0.2;  // of a corner: weighs what is known in metres against pixels

  std::size_t slots(int target) const {
    return targets[static_cast<std::size_t>(target)].stands ? 1 : static_cast<std::size_t>(frames);
  }
  // Of a camera's lens: which parameters are estimated.
  std::vector<std::size_t> free_parameters(int index, const Camera& camera) const;
  bool turntable() const { return !table_angles.empty(); }
  std::size_t rig_slot(int frame) const { return turntable() ? 0 : static_cast<std::size_t>(frame); }
  std::size_t slot(int target, int frame) const {
    return targets[static_cast<std::size_t>(target)].stands ? 0 : static_cast<std::size_t>(frame);
  }
};

struct BundleState {
  std::vector<Camera> cameras;
  std::vector<Pose> rig_from_world;  // of each frame; one before a turntable; empty: the rig stands
  std::vector<std::vector<Pose>> world_from_target;    // [target][slot]
  std::vector<Eigen::Vector2d> bending_m;              // [target]
  std::vector<std::vector<Eigen::Vector3d>> shifts_m;  // [target][point], from the nominal one; empty: exact
};

// Sizes filled with identities and zeros.
BundleState empty_state(const BundleProblem& problem, std::vector<Camera> cameras);

Pose camera_pose(const Camera& camera);
void set_pose(Camera& camera, const Pose& pose);
// The turn of the table in a frame; the identity without one.
Pose table_turn(const BundleProblem& problem, int frame);
Pose rig_from_target(const BundleProblem& problem, const BundleState& state, int target, int frame);
Eigen::Vector3d target_point(const BundleProblem& problem, const BundleState& state, int target, int point);
// Measured minus projected, in pixels; nullopt where the state projects the corner nowhere.
std::optional<Eigen::Vector2d> residual(const BundleProblem& problem, const BundleState& state,
                                        const CornerObservation& corner);
// Of the used corners (both axes), a standard deviation that outliers do not move: median |r| / 0.6745.
double robust_sigma(const BundleProblem& problem, const BundleState& state);

}  // namespace bpms
