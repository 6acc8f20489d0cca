// Which lens model the images carry, by cross-validation over frames and never by residuals, which a longer
// model always lowers. The frames are dealt into folds. Each fold's frames are left out of a solve; in each
// of them the pose of the target is fitted, with lenses and rig fixed, to every other corner, and the
// remaining corners are predicted; then the other way round. Of the models that predict as well as the best
// one, within one standard error of the difference frame by frame, the one with the fewest parameters is
// chosen (Breiman et al. 1984, 3.4.3).
#pragma once
#include <string>
#include <vector>

#include "calibrate/calibrate.h"

namespace bpms {

struct LensSelectionOptions {
  std::vector<std::string> candidates = {"brown4", "fisheye", "brown5", "brown8", "splined"};  // simple first
  int folds = 5;
  CalibrateOptions calibrate = {};  // but for the lens
};

struct LensScore {
  std::string lens;
  int parameters = 0;  // of one camera's lens, those held fixed left out
  double in_sample_rms_px = 0;
  double predicted_rms_px = 0, predicted_se_px = 0;  // per axis, of the corners predicted
  double worse_px2 = 0, worse_se_px2 = 0;            // mean square beyond the best model's, frame by frame
  bool chosen = false;
  std::string refused;  // why it is no candidate; else empty
};

struct LensSelection {
  std::string chosen;
  int folds = 0, frames = 0, corners = 0;  // corners predicted
  std::vector<LensScore> scores;           // in the order of the candidates
};

// bad_input for fewer than 4 frames; numeric error when no model is sound.
LensSelection choose_lens(const Observations& observations, const std::vector<Target>& targets,
                          const LensSelectionOptions& options = {});

}  // namespace bpms
