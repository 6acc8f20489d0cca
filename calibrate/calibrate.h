// Front door of calibration: corners of a target seen by one or more cameras -> the rig, with its covariance
// and an account of every view. The uncertainty is given twice: iid (as if every corner erred on its own) and
// clustered by frame, which is the honest one: corners of one image err together (bent board, blur, lens
// model).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "calibrate/observations.h"
#include "calibrate/rig.h"
#include "calibrate/targets/target.h"

namespace bpms {

struct CalibrateOptions {
  std::string lens = "brown4";  // of all cameras: a choice of calibrate/lenses/lens.h
  bool board_warp = true;       // estimate the board's bending
  bool uncertainty = true;      // clustered sigmas and half sets: a solve for every frame left out
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
  Eigen::Vector2d board_warp_m = Eigen::Vector2d::Zero();

  struct View {
    std::string image, camera, frame;
    double rms_px = 0;  // per axis, over all corners that were found
    bool outlier = false;
    std::string reason;                      // why it is one; else empty
    std::vector<Eigen::Vector4d> residuals;  // u, v, measured minus projected; of the corners used
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

  struct HalfSets {  // of the first pair; frames with odd and even numbers
    double odd_baseline_m = 0, even_baseline_m = 0, sigma_clustered_m = 0;
  };
  std::optional<HalfSets> half_sets;
  double solve_seconds = 0, uncertainty_seconds = 0;
};

// bad_input: fewer than 3 views of a camera, a camera that shares no frame with the others. numeric: no
// convergence, parameters that the views do not determine, a lens that folds inside its image.
Calibration calibrate(const Observations& observations, const Target& target,
                      const CalibrateOptions& options = {});

// The first pixel, on a grid over the image or the part of it in a convex region, that no ray leads to or
// about which the lens folds; nullopt when the lens is sound.
std::optional<Eigen::Vector2d> pixel_without_ray(const Camera& camera,
                                                 const std::vector<Eigen::Vector2d>& region = {});

}  // namespace bpms
