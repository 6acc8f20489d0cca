// Forward mode: photons from the light through the scene, for fluxes and for many views at once.
// Definitions: docs/forward.md.
#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "simulate/simulate.h"

namespace bpms {

enum class Flux {
  reflected,           // leaves through the top
  transmitted,         // arrives at the ground from above, each time (or leaves through the bottom)
  transmitted_first,   // the same before the ground has reflected any of it: over a black ground
  transmitted_direct,  // the same before anything has scattered it
  lost_sides,          // open scenes: leaves through the sides of the box
  lost_wraps,          // periodic scenes: ended by the wrap limit
  absorbed_canopy,     // by all but the ground plane; fAPAR by band
  absorbed_ground,     // by the ground plane
  absorbed_material,   // the ground's too
  absorbed_organ,
  absorbed_plant,
  absorbed_layer,     // of the canopy
  ground_irradiance,  // a pixel's mean over the mean incident on the horizontal
};
const char* name_of(Flux flux);

struct FluxRow {
  Flux flux = Flux::reflected;
  std::string of;           // material, "prototype/organ", "prototype 12", or "0.5-1 m"
  std::uint32_t index = 0;  // of the material, instance, layer or pixel; of the organ within its prototype
  std::uint32_t prototype = 0;
};

struct FluxResult {
  std::vector<FluxRow> rows;
  std::vector<Origin> origins;  // total first, then direct and diffuse where both are there
  std::vector<Estimates>
      fraction;  // by origin: rows x written bands, of the power that enters from that origin
  std::vector<std::vector<double>> entering;  // by origin, per band: irradiance (on the horizontal) x m2
  double ground_area_m2 = 0;                  // of the cell, or of the open scene's box
  std::array<int, 2> map_px{0, 0};
  std::uint64_t samples = 0, rays = 0;
  std::string stopped_by;  // target_se, samples, max_samples, max_seconds, interrupt

  // The row of a flux, by its index; rows.size() where there is none.
  std::size_t row(Flux flux, std::uint32_t index = 0, std::uint32_t prototype = 0) const;
};

// target_se concerns reflected, transmitted and absorbed_canopy of the total, in every band. Stops at the
// deadline with what is done, at least one round.
FluxResult trace_fluxes(
    const Simulation& simulation, const Intersector& intersector, std::uint64_t seed,
    const FluxOptions& options = {},
    std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max());

// What the sums and the result of these fluxes take, in bytes; before they are made.
std::uint64_t flux_bytes(const Simulation& simulation, const FluxOptions& options);

}  // namespace bpms
