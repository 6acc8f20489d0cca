// The homogeneous disc canopy of the benchmark (LAI 3, data bench_hom) in red and NIR, as a Simulation
// without a file.
#pragma once
#include <string>

#include "simulate/simulate.h"

namespace bpms::bench {

// `views` in degrees, principal plane, negative on the sun's side.
Simulation homogeneous(const std::string& data_folder, const std::vector<double>& vza_deg);

}  // namespace bpms::bench
