// Area, volume and centroid of the organs of a mesh, from its triangles (divergence theorem). A leaf is a
// sheet: it has no volume, and its centroid is that of its area. Bodies must be closed.
// plant_mesh() fills Mesh::Organ::volume_m3 and centroid_m from the organs' own shapes, without the
// triangles' error; these functions are for meshes from elsewhere, and to hold the two against each other.
#pragma once
#include <vector>

#include "plant/mesh.h"

namespace bpms {

struct OrganMass {
  double area_m2 = 0;
  double volume_m3 = 0;
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();
};
std::vector<OrganMass> triangle_masses(const Mesh& mesh);  // an entry an organ

// Of the whole plant by its organs' own numbers: all area, all volume, and where the bodies' centroid lies
// (where there is none: that of the leaf area).
OrganMass plant_mass(const Mesh& mesh);

}  // namespace bpms
