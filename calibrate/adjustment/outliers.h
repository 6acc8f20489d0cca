// Which corners and views are no good. A Cauchy loss finds the solution that most corners agree on; what lies
// far from it is left out, and the last solve is plain least squares.
#pragma once
#include "calibrate/adjustment/bundle_adjustment.h"

namespace bpms {

struct OutlierSearch {
  std::vector<double> view_rms_px;  // of each view, per axis, over all of its corners that project
  std::vector<bool> view_out;       // fits much worse than the others do
  double sigma_px = 0;              // robust, of the last round
  AdjustResult last;                // of the final least squares
};
// Sets `used` of every corner, moves the state to the least squares solution over those in use.
OutlierSearch fit_without_outliers(BundleProblem& problem, int views, BundleState& state);

}  // namespace bpms
