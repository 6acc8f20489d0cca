// What a run needs beside the scene: the results of its sensors and the sums of its fluxes, estimated before
// they are made.
#pragma once
#include "simulate/transport/stage.h"

namespace bpms {

// Refuses (missing_resource) a run that is estimated to need more than Simulation::most_bytes, and names what
// needs most. What is traced was held against the limit when it was built.
void require_memory(const Simulation& simulation, const Stage& stage);

}  // namespace bpms
