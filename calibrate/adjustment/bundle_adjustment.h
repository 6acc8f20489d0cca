// The joint adjustment of cameras, poses of the board and the board's bending to the corners seen: least
// squares of the pixel residuals, or with a Cauchy loss where outliers are still to be found. The rig's frame
// is camera 0's; the board gives the scale. Board: z += w0 (1 - x^2) + w1 (1 - y^2), x, y in [-1, 1].
#pragma once
#include <optional>
#include <vector>

#include "calibrate/pose.h"
#include "calibrate/rig.h"

namespace bpms {

struct CornerObservation {
  int view = 0;
  int frame = 0;
  int camera = 0;
  int point = 0;
  Eigen::Vector2d pixel;
  bool used = true;
};

struct BundleProblem {
  std::vector<Eigen::Vector3d> points_m;  // on the board
  std::vector<Eigen::Vector2d> bending;   // of each point
  bool free_bending = true;
  int frames = 0;
  std::vector<CornerObservation> corners;
};

struct BundleState {
  std::vector<Camera> cameras;
  std::vector<Pose> rig_from_board;  // of each frame
  Eigen::Vector2d bending_m = Eigen::Vector2d::Zero();
};

Eigen::Vector3d board_point(const BundleProblem& problem, const BundleState& state, int point);
// Measured minus projected, in pixels; nullopt where the state projects the corner nowhere.
std::optional<Eigen::Vector2d> residual(const BundleProblem& problem, const BundleState& state,
                                        const CornerObservation& corner);
// Of the used corners (both axes), a standard deviation that outliers do not move: median |r| / 0.6745.
double robust_sigma(const BundleProblem& problem, const BundleState& state);

constexpr double prior_sigma_px = 0.2;  // of a corner: weighs a lens model's priors against pixels

struct AdjustOptions {
  double cauchy_px = 0;      // scale of the loss; 0 = plain least squares
  double tolerance = 1e-14;  // relative change of the cost at which the last step counts as converged
  int most_iterations = 500;
};
struct AdjustResult {
  bool converged = false;
  int iterations = 0;
};
// Moves `state` to the minimum over the used corners. The state must project every one of them.
AdjustResult adjust(const BundleProblem& problem, const AdjustOptions& options, BundleState& state);

}  // namespace bpms
