// The meshes of single organs, in the organ's own frame, in double precision.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "plant/plant.h"

namespace bpms {

struct OrganMesh {
  std::vector<Eigen::Vector3d> positions_m;
  std::vector<Eigen::Vector3d> normals;
  std::vector<Eigen::Vector2d> uv;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::uint32_t add(const Eigen::Vector3d& position_m, const Eigen::Vector3d& normal, double u, double v);
  void reserve(std::size_t vertices, std::size_t faces);
  double area_m2() const;
};

// A row of vertices first .. first+count-1; one vertex where the row has shrunk to a point.
struct VertexRow {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};
// Triangles between two rows, facing along (next - row) x (across); quads are cut along their shorter
// diagonal.
void join_rows(OrganMesh& mesh, const VertexRow& row, const VertexRow& next);

OrganMesh leaf_mesh(const OrganAttributes& leaf, double tolerance_m);
// Stem (a tube with flat ends), head and bud (rounded).
OrganMesh swept_mesh(OrganKind kind, const OrganAttributes& organ, double tolerance_m);

}  // namespace bpms
