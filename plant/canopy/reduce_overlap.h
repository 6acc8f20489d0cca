// [overlap] of canopy.toml: the overlap between plants reported, and reduced within what the pattern allows.
#pragma once
#include "plant/canopy/place_plants.h"

namespace bpms {

struct CanopyOverlapOptions {
  bool report = false;
  std::optional<double> at_most;  // share of the leaf area
  int tries = 20;                 // new rotations and places for a plant that crosses others
};
CanopyOverlapOptions read_overlap(const TomlValue& root);

// Meets options: fills in Canopy::overlap, notes it, and where it is to be reduced gives plants that cross
// others new rotations (the first half of the tries) and new places of the pattern with new rotations (the
// second half), each kept when less leaf area then crosses. The same seed gives the same canopy.
void handle_overlap(const TomlValue& root, const CanopyOverlapOptions& options,
                    const std::vector<PlantingSite>& sites, PlantingField& field, const Standing& standing,
                    const PlantSource* source, Canopy& canopy);

}  // namespace bpms
