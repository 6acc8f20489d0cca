// Plants anywhere, independently of each other; their number is the density times the area, rounded.
#include "plant/canopy/pattern.h"

namespace bpms {

std::vector<PlantingSite> plant_random(const TomlValue& planting, PlantingField& field) {
  const TomlValue density = planting.require("density_per_m2");
  std::vector<PlantingSite> out(plant_count(density.positive() * field.area_m2(), density));
  for (PlantingSite& site : out) site.xy_m = field.anywhere();
  return out;
}

}  // namespace bpms
