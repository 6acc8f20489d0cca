// The plants of the sites: which, how turned, how large, and where on the ground.
#pragma once
#include "plant/canopy.h"
#include "plant/canopy/pattern.h"
#include "plant/plant_source.h"

namespace bpms {

// How plants stand on the ground below them.
struct Standing {
  MeanSd depth_m;             // of the base below ground
  bool above_ground = true;   // the sites' z is; else it is a height by itself
  bool along_normal = false;  // tilted with the ground; else upright
};
Standing read_standing(const TomlValue& planting);

// Fills in plants and placements of the canopy, whose ground is known. `source` may be null where every site
// names its plant.
void place_plants(const std::vector<PlantingSite>& sites, const PlantingField& field,
                  const Standing& standing, PlantSource* source, const TomlValue& planting, Canopy& canopy);

// Puts a placed plant elsewhere, as deep as it was.
void move_placement(const Eigen::Vector2d& to, const Standing& standing, const Canopy& canopy,
                    Placement& placement);

}  // namespace bpms
