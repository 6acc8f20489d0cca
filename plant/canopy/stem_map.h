// A stem map: a CSV table of plants as they were found, columns x_m, y_m and, as far as known, z_m,
// rotation_deg, scale, plant; other columns are passed over. `plant` is a file (.bpms) beside the table. A
// cell left empty is as if its column were absent for that row.
#pragma once
#include <vector>

#include "core/toml.h"
#include "plant/canopy/pattern.h"

namespace bpms {
std::vector<PlantingSite> read_stem_map(const TomlValue& table, PlantingField& field);
}  // namespace bpms
