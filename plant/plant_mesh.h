// A plant's surface as triangles, in the plant's frame (metres, z up).
// Leaves are single-layer strips whose triangle area is the one-sided area; stems, heads and buds are closed
// bodies with outward normals. The distance between mesh and surface stays below the tolerance.
#pragma once
#include "plant/mesh.h"
#include "plant/plant.h"

namespace bpms {

struct MeshOptions {
  // Largest distance between triangles and surface. The one-sided area of a leaf agrees with the integral
  // over its surface to 1e-4 at any tolerance that keeps the shape (the width absorbs what the chords lose).
  double tolerance_m = 1e-4;
  bool parameters = false;  // fill in Mesh::Organ::parameters
  // False: leaves alone have triangles; bodies have their rows all the same, with their exact area, for those
  // who take their solids (plant/plant_solids.h).
  bool bodies = true;
};
Mesh plant_mesh(const Plant& plant, const MeshOptions& options = {});

// The one-sided area of a leaf by quadrature over its parametric surface, not over triangles.
double leaf_surface_area_m2(const OrganAttributes& leaf);

}  // namespace bpms
