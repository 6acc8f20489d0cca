// Levels of detail of a plant's surface: meshes of ever fewer triangles, each made anew from the plant's
// functions at a coarser tolerance. The leaf area is kept at every level (plant_mesh.h), and with it what
// depends on area and angle: leaf area index and G.
#pragma once
#include <vector>

#include "plant/mesh.h"
#include "plant/plant.h"
#include "plant/plant_mesh.h"

namespace bpms {

struct MeshLevel {
  double tolerance_m = 0;
  Mesh mesh;
  double deviation_m = 0;  // the largest distance of the finest level's vertices from this one's triangles
};
// The first at options.tolerance_m, each further one at `factor` times the tolerance of the one before.
std::vector<MeshLevel> mesh_levels(const Plant& plant, const MeshOptions& options, int levels,
                                   double factor = 4);

// The largest distance of the vertices of one mesh from the triangles of another, organ by organ (rows of
// both agree).
double vertex_deviation_m(const Mesh& of, const Mesh& from);

}  // namespace bpms
