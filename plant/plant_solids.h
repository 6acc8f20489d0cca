// Stems, buds and seed heads as solids with a formula, for those who need no triangles of them: a straight
// stem is one cylinder, a bud a sphere, a straight head a spheroid; what bends or widens is a chain of closed
// frusta of cones that stays within the tolerance of it. The links of a chain reach into each other at its
// bends, so that no ray sees between them; what lies inside of the chain (the links' hidden ends) is no
// surface of the organ: its area is the organ's, Mesh::Organ::area_m2, and not the sum of its links'.
#pragma once
#include <vector>

#include "plant/plant.h"

namespace bpms {

struct PlantSolid {
  enum class Kind { spheroid, frustum };
  Kind kind = Kind::frustum;
  Eigen::Vector3d from_m, to_m;  // ends of the axis, in the plant's frame
  // Of a frustum's ends; of a spheroid both the radius across.
  double first_radius_m = 0, second_radius_m = 0;
  int organ_id = 0;  // PlacedOrgan::id, Mesh::Organ::id
};
std::vector<PlantSolid> plant_solids(const Plant& plant, double tolerance_m = 1e-4);

}  // namespace bpms
