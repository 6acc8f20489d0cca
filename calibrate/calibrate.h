// Front door of calibration: corners of a target seen by one or more cameras -> the rig, with its covariance
// and an account of every view. The uncertainty is given twice: iid (as if every corner erred on its own) and
// clustered by frame, which is the honest one: corners of one image err together (bent board, blur, lens
// model).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "calibrate/observations.h"
#include "calibrate/pose.h"
#include "calibrate/projection_uncertainty.h"
#include "calibrate/rig.h"
#include "calibrate/targets/target.h"

namespace bpms {

struct CalibrateOptions {
  std::string lens = "brown4";  // of all cameras: a choice of calibrate/lenses/lens.h
  bool board_warp = true;       // estimate the bending of flat boards
  // The rig is carried around a target that stands (one at least must); else it stands and boards are held.
  bool rig_moves = false;
  // Points of what stands: as surveyed (with their covariance where they have one), or estimated with the
  // place that they have together as the datum: a free network.
  bool free_points = false;
  // Not 0: the targets stand on a table that turns by so much from one frame number to the next, before
  // cameras that stand. Positive is right-handed about the axis that comes out.
  double table_step_rad = 0;
  bool uncertainty = true;  // clustered sigmas and half sets: a solve for every frame left out
};

struct Calibration {
  Rig rig;
  bool converged = false;
  int frames = 0;

  double residual_rms_px = 0;    // of each axis, no correction
  double residual_sigma_px = 0;  // with degrees of freedom
  int degrees_of_freedom = 0;
  int corners_used = 0;
  int corners_total = 0;

  struct TargetResult {
    std::string name;
    Eigen::Vector2d warp_m = Eigen::Vector2d::Zero();
    int views = 0;
    bool stands = false;
    std::vector<Eigen::Vector3d> points_m;  // where points were estimated, else empty
    struct Bar {
      ScaleBar bar;
      double found_m = 0;
    };
    std::vector<Bar> bars;
  };
  std::vector<TargetResult> targets;
  // Poses for those who want to go on from here; identity where nothing was seen.
  struct Poses {
    std::vector<std::string> frames;
    std::vector<Pose> rig_from_world;                  // of a rig that moves
    std::vector<std::vector<Pose>> world_from_target;  // [target][frame, or 0 of one that stands]
  };
  Poses poses;

  struct View {
    std::string image, camera, frame;
    int target = 0;
    double rms_px = 0;  // per axis, over all corners that were found
    bool outlier = false;
    std::string reason;                      // why it is one; else empty
    std::vector<Eigen::Vector4d> residuals;  // u, v, measured minus projected; of the corners used
    std::vector<int> points;                 // of the target, one for each residual
  };
  std::vector<View> views;
  struct Outlier {
    std::string image;
    int corner = 0;
    double residual_px = 0;
  };
  std::vector<Outlier> outliers;

  // In the order of rig.covariance->order. Clustered: delete-one-frame jackknife below 20 frames, sandwich by
  // frame with n/(n-1) from there on; absent with a reason where it cannot be had.
  Eigen::VectorXd sigma_iid, sigma_clustered;
  std::string clustered_absent;

  struct Pair {
    int a = 0, b = 0;
    double baseline_m = 0, baseline_sigma_m = 0;
    std::optional<double> baseline_sigma_clustered_m;
    Eigen::Vector3d rotation_vector = Eigen::Vector3d::Zero();  // of b from a, radians
    Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
  };
  std::vector<Pair> pairs;

  struct HalfSets {  // the first, third, ... frame (odd) and the others (even)
    double odd_baseline_m = 0, even_baseline_m = 0, sigma_clustered_m = 0;  // of the first pair, or zeros
    std::vector<ProjectionMap> difference;                                  // of each camera
  };
  std::optional<HalfSets> half_sets;
  // Of each camera at the usual distance of its corners, from the covariance by frame.
  std::vector<ProjectionMap> projection;
  struct Turntable {  // its axis in the rig's frame, direction and nearest point to the origin
    Eigen::Vector3d direction = Eigen::Vector3d::Zero(), point_m = Eigen::Vector3d::Zero();
    // The larger standard deviations, iid and by frame: of the direction, of the point across the axis.
    double direction_sigma_rad = 0, point_sigma_m = 0, direction_sigma_clustered_rad = 0,
           point_sigma_clustered_m = 0;
    // Between the first, third, ... frame and the others; absent where halves have too few frames.
    std::optional<double> halves_angle_rad, halves_distance_m;
  };
  std::optional<Turntable> turntable;
  double solve_seconds = 0, uncertainty_seconds = 0;
};

// bad_input: fewer than 3 views of a camera, a camera that shares no frame with the others. numeric: no
// convergence, parameters that the views do not determine, a lens that folds inside its image.
Calibration calibrate(const Observations& observations, const std::vector<Target>& targets,
                      const CalibrateOptions& options = {});
inline Calibration calibrate(const Observations& observations, const Target& target,
                             const CalibrateOptions& options = {}) {
  return calibrate(observations, std::vector<Target>{target}, options);
}

// The first pixel, on a grid over the image or the part of it in a convex region, that no ray leads to or
// about which the lens folds; nullopt when the lens is sound.
std::optional<Eigen::Vector2d> pixel_without_ray(const Camera& camera,
                                                 const std::vector<Eigen::Vector2d>& region = {});

}  // namespace bpms
