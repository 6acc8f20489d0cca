// What was observed, as an adjustment takes it; refused where it cannot be enough.
#pragma once
#include <string>
#include <vector>

#include "calibrate/adjustment/network.h"
#include "calibrate/calibrate.h"

namespace bpms {

// bad_input: no views, or fewer than 3 of a camera. Where `one_will_do`, one is enough: what stands or turns
// on a table is placed by the other cameras; such a camera is a pinhole with the principal point at the
// centre.
void require_views(const Observations& observations, bool one_will_do);
// In order of their numbers, "9" before "10".
std::vector<std::string> frame_names(const Observations& observations);
// bad_input: corners that no target has, a rig that moves without a target that stands, a scale bar that
// contradicts an exact target.
BundleProblem network_problem(const Observations& observations, const std::vector<Target>& targets,
                              const std::vector<std::string>& frames, const CalibrateOptions& options);

}  // namespace bpms
