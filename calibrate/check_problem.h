// The linearised shot of a board behind a rig check: residuals and their derivatives by the rig's numbers,
// the poses of the board, its bending and its size.
#pragma once
#include <vector>

#include "calibrate/observations.h"
#include "calibrate/pose.h"
#include "calibrate/rig.h"
#include "calibrate/targets/target.h"

namespace bpms {

struct ShotCorner {
  int camera = 0;  // of the rig
  int frame = 0;
  int point = 0;
  Eigen::Vector2d pixel;
};
struct Shot {
  std::vector<Eigen::Vector3d> points_m;
  std::vector<Eigen::Vector2d> bending;
  std::vector<ShotCorner> corners;
  int frames = 0;
};

// Square roots of covariances, and which camera's number each of their rows is. Common to all frames: the
// error of the calibration. Of each frame anew: what corners of one frame err together, seen as an error of
// the rig.
struct RigErrors {
  struct Row {
    int camera = 0;
    int parameter = -1;  // of the lens; -1: of the pose
    int pose = -1;
  };
  std::vector<Row> rows;
  Eigen::MatrixXd root;        // C = root root'
  Eigen::MatrixXd frame_root;  // no columns where the covariance does not tell
};
RigErrors rig_errors_of(const Rig& rig);

struct ShotFit {
  double chi2 = 0;
  int coordinates = 0;
  double rms_px = 0;
  std::vector<Pose> rig_from_board;
  Eigen::Vector2d bending_m = Eigen::Vector2d::Zero();
  double log_scale = 0, log_scale_sigma = 0;
};
struct ShotFitOptions {
  double sigma_px = 1;
  bool bending = true, scale = false;
};
// Generalised least squares as above. numeric error when no board fits.
ShotFit fit_shot(const Rig& rig, const RigErrors& errors, const Shot& shot, const ShotFitOptions& options);

}  // namespace bpms
