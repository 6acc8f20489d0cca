// A calibration as the JSON of `bpms calibrate --report`.
#pragma once
#include "apps/bpms/verb.h"
#include "calibrate/calibrate.h"
#include "calibrate/lens_selection.h"

namespace bpms {
Json calibration_json(const Calibration& calibration, const Observations& observations,
                      const std::vector<Target>& targets, const std::string& model);
// A row a model, in the order they were tried.
Json lens_selection_json(const LensSelection& selection);
}  // namespace bpms
