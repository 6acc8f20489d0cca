// The table [domain] of canopy.toml: size_m, or for an open canopy the size that a sensor asks for; boundary,
// seed, snap.
#pragma once
#include "plant/canopy.h"
#include "plant/canopy/pattern.h"

namespace bpms {
// Fills in size, boundary and seed of the canopy; returns the field to be planted, nothing drawn yet.
PlantingField read_canopy_domain(const TomlValue& root, const CanopyReadOptions& options, Canopy& canopy);
}  // namespace bpms
