// Leaves as bicubic Bezier patches: on a grid of rows along the midrib and columns across (folds are columns)
// the patches have the surface's positions, its derivatives and mixed derivatives at their corners (Hermite),
// halved until they stay within the tolerance of it. U runs along the leaf and V across, the upper face is
// the patches' front. Neighbours share their edge curves.
#pragma once
#include <string>
#include <vector>

#include "plant/geometry/bezier.h"
#include "plant/plant.h"

namespace bpms {

struct LeafPatch {
  BezierPatch points;  // metres
  // Where it lies on the leaf; the panel of its section (a fold is in two).
  double l_from = 0, l_to = 0, s_from = 0, s_to = 0;
  int panel = 0;
};
std::vector<LeafPatch> leaf_patches(const OrganAttributes& leaf, double tolerance_m);  // in the organ's frame

// All leaves of a plant, in its frame.
std::vector<BezierPatch> plant_patches(const Plant& plant, double tolerance_m);
// Newell's layout (.bpt): how many, then for each the degrees and 16 points, in metres.
std::string patch_file_text(const std::vector<BezierPatch>& patches);

}  // namespace bpms
