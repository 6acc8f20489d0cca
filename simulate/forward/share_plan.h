// How many rays and photon paths each view takes to its target, for the least work in all: paths are traced
// once for all views, but each view looks at their vertices by itself, and only at as many as it needs.
#pragma once
#include <cstdint>
#include <vector>

#include "simulate/forward/view_sums.h"

namespace bpms {

struct ViewGoal {
  std::uint64_t rays = 0, photons = 0;  // a batch
};

// Seconds (about: ratios matter) that one takes.
struct ShareCosts {
  double ray, look, trace;  // a view's ray with its sun ray; one path's vertices in one view; one path
};

// From what the views know so far; a view that is done keeps what it has. Grows by at most 16 times.
std::vector<ViewGoal> plan_views(const std::vector<ViewSums>& views, const Sources& sources,
                                 const ShareCosts& costs);

// Has the view reached its target?
bool is_reached(const ViewSums::Variances& view, const Sampling& sampling);

}  // namespace bpms
