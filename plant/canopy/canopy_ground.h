// What the plants of a canopy stand on: [terrain] and [ridges] of canopy.toml.
#pragma once
#include "plant/canopy.h"
#include "plant/canopy/pattern.h"

namespace bpms {
// Nothing where the file has neither table. The field's pattern is planted (its rows give the ridges).
std::optional<CanopyGround> read_canopy_ground(const TomlValue& root, PlantingField& field, Canopy& canopy);
}  // namespace bpms
