// The sources of plants (plant/plant_source.h) and what their entries share.
#pragma once
#include <memory>

#include "plant/canopy/clone_variation.h"
#include "plant/plant_source.h"

namespace bpms {
std::unique_ptr<PlantSource> clone_source(const TomlValue& entries);
std::unique_ptr<PlantSource> explicit_source(const TomlValue& entries, bool shuffled);
}  // namespace bpms
