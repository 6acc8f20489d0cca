// A height field: heights at the nodes of a regular grid, each of its squares cut in two triangles along the
// diagonal from south-west to north-east. Metres, x east, y north.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/toml.h"
#include "plant/mesh.h"

namespace bpms {

struct Terrain {
  std::size_t columns = 0, rows = 0;                    // of nodes
  Eigen::Vector2d spacing_m = Eigen::Vector2d::Ones();  // along x and along y
  Eigen::Vector2d low_m = Eigen::Vector2d::Zero();      // the south-western node
  std::vector<float> heights_m;                         // by rows from the south, each from the west
  // What rays meet: normals at the nodes are those of central differences, (U,V) runs from the south-western
  // node (0, 0) to the north-eastern one (1, 1).
  std::shared_ptr<const Mesh> mesh;

  Eigen::Vector2d size_m() const;
  bool covers(const Eigen::Vector2d& at) const;
  // Of the triangles at a point that it covers (the nearest edge's beyond them).
  double height_m(const Eigen::Vector2d& at) const;
  // The mesh's normals at the corners of the triangle there, interpolated; unit.
  Eigen::Vector3d normal(const Eigen::Vector2d& at) const;
  // The largest difference in height between opposite edges: 0 where it can be repeated without a step.
  double edges_differ_by_m() const;
};

// Fills in the mesh. `repeats`: the normals at the edges are those of the field repeated without end.
void make_terrain_mesh(Terrain& terrain, bool repeats);

// Of a table with file (an ESRI ASCII grid), centred, offset_m. `periodic_m`: the size of the periodic domain
// that it must fill and repeat in without a step, or null. The file is added to the inputs.
std::shared_ptr<const Terrain> read_terrain(const TomlValue& table, const Eigen::Vector2d* periodic_m,
                                            std::vector<std::string>& inputs);

}  // namespace bpms
