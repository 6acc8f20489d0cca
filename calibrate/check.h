// Does a rig still hold? A shot of a board, taken with the rig as it stands today, against what its
// calibration and the noise of corners predict.
//   r = e + J_rig d + J_board b,   e ~ N(0, sigma^2 I),   d ~ N(0, C): the error of the rig as it was
//   calibrated
// r: measured minus projected corners of all cameras together, b: the poses of the board (one a frame) and
// its bending, both free. With S = sigma^2 I + J_rig C J_rig' and b eliminated by generalised least squares,
// r' S^-1 (r - J_board b) is chi-square with as many degrees of freedom as there are coordinates less free
// numbers, when the rig holds. sigma is the rig's residual_sigma_px. Corners of one frame err together
// besides (blur, what the lens model lacks), which sigma does not know: a covariance clustered by frame is
// larger than the iid one by the mean of such errors over its n frames, so n times the difference is what the
// one frame of a shot adds, T = n (C - C_iid), as an error of the rig in this frame alone: S also has J_rig T
// J_rig'. There C is C_iid
// times one factor, the mean ratio of the variances. Without T one in four shots of a sound real rig was
// refused.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "calibrate/observations.h"
#include "calibrate/rig.h"
#include "calibrate/targets/target.h"

namespace bpms {

struct RigCheckOptions {
  double least_p = 1e-3;       // what is less probable does not hold
  bool board_warp = true;      // the bending of the board is not known
  double corner_sigma_px = 0;  // 0: the rig's residual_sigma_px
};

struct ChiSquareVerdict {
  std::string name;
  double chi2 = 0;
  int dof = 0;
  double p = 0;
  bool holds = false;
};

struct RigCheck {
  ChiSquareVerdict rig;                   // all cameras jointly
  std::vector<ChiSquareVerdict> cameras;  // each alone, which tests its lens; those seen in the shot
  // A length of the board's that the rig measures, over what the board's file says; of two cameras or more. A
  // wrong board, a moved camera and a changed focal length all show here.
  struct Scale {
    double ratio = 1, sigma = 0, p = 1;
    bool holds = true;
  };
  std::optional<Scale> scale;
  struct Epipolar {
    std::string a, b;
    double rms_px = 0;       // distance of corners of b to the epipolar lines of a's
    double expected_px = 0;  // by sigma alone
    int corners = 0;
  };
  std::vector<Epipolar> pairs;
  double corner_sigma_px = 0;
  double residual_rms_px = 0;  // of each axis, the board fitted
  bool rig_has_covariance = false;
  std::string swapped;  // "left and right": two cameras whose images fit far better exchanged; else empty
  bool holds() const;
};

// bad_input: cameras that the rig does not have, no corner, no noise known.
RigCheck check_rig(const Rig& rig, const Observations& shot, const Target& target,
                   const RigCheckOptions& options = {});

// Probability of a chi-square as large or larger.
double chi_square_tail(double chi2, int dof);

}  // namespace bpms
