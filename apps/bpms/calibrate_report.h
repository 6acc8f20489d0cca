// A calibration as the JSON of `bpms calibrate --report`.
#pragma once
#include "apps/bpms/verb.h"
#include "calibrate/calibrate.h"

namespace bpms {
Json calibration_json(const Calibration& calibration, const Observations& observations,
                      const std::vector<Target>& targets, const std::string& model);
}  // namespace bpms
