// Forward or reverse? Chosen by the cost of what a sensor asks for.
//
// Images, receivers and open scenes: reverse. Fluxes: always forward. Directions of parallel rays: shared
// photon paths cost one tracing for all views and then, for each view, a look from every vertex; the reverse
// mode costs whole paths for every view. Looks through a grid (scenes of discs) are many times cheaper than
// those through the hierarchy (meshes), but a view needs up to three times as many photon paths as reverse
// paths to the same error (grazing views most). So sharing is taken from a few views on; the two numbers
// below are estimates.
#pragma once
#include <string>

#include "simulate/simulate.h"

namespace bpms {

Mode read_mode(const TomlValue& value);  // "reverse", "forward", "auto"

inline constexpr std::size_t views_worth_sharing_grids = 4;
inline constexpr std::size_t views_worth_sharing = 12;  // where meshes leave no grids

// Reverse or forward. Throws bad_input, at `where`, when forward was asked for and cannot be.
Mode choose_mode(Mode asked, const Simulation& simulation, const Sensor& sensor, const SourceLocation& where);

}  // namespace bpms
