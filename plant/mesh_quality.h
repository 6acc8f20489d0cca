// How good a mesh is as a mesh: thin and degenerate triangles, faces that are there twice, edges of more than
// two triangles, and surfaces that cross themselves (a leaf that is rolled past 180 degrees, or bent
// back onto itself). Vertices at one place count as one.
#pragma once
#include <vector>

#include "plant/mesh.h"

namespace bpms {

struct MeshQualityOptions {
  bool between_organs = false;  // also which organs cross each other
  double sliver_deg = 1;        // a triangle with an angle below it is one
};

struct MeshCrossing {
  std::uint32_t organ = 0, other = 0;              // indices into Mesh::organs; the same: it crosses itself
  std::size_t pairs = 0;                           // of triangles
  double l = 0;                                    // U of the first pair's first triangle: along the organ
  Eigen::Vector3d at_m = Eigen::Vector3d::Zero();  // its middle
};

struct MeshQuality {
  std::size_t triangles = 0;
  double smallest_angle_deg = 180;
  double largest_aspect = 1;  // longest side over the height on it, in units of an equilateral triangle's
  std::size_t slivers = 0, degenerate = 0, duplicate_faces = 0, non_manifold_edges = 0;
  std::vector<MeshCrossing> crossings;  // by organ, then other
};
MeshQuality mesh_quality(const Mesh& mesh, const MeshQualityOptions& options = {});

}  // namespace bpms
