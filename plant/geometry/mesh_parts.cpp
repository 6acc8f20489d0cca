#include "plant/geometry/mesh_parts.h"

namespace bpms {

std::uint32_t OrganMesh::add(const Eigen::Vector3d& position_m, const Eigen::Vector3d& normal, double u,
                             double v) {
  positions_m.push_back(position_m);
  normals.push_back(normal);
  uv.emplace_back(u, v);
  return static_cast<std::uint32_t>(positions_m.size() - 1);
}

void OrganMesh::reserve(std::size_t vertices, std::size_t faces) {
  positions_m.reserve(vertices);
  normals.reserve(vertices);
  uv.reserve(vertices);
  triangles.reserve(faces);
}

double OrganMesh::area_m2() const {
  double sum = 0;
  for (const auto& [a, b, c] : triangles)
    sum += (positions_m[b] - positions_m[a]).cross(positions_m[c] - positions_m[a]).norm() / 2;
  return sum;
}

void join_rows(OrganMesh& mesh, const VertexRow& row, const VertexRow& next) {
  if (row.count == 1 && next.count == 1) return;
  const std::uint32_t columns = std::max(row.count, next.count) - 1;
  for (std::uint32_t j = 0; j < columns; ++j) {
    const std::uint32_t a = row.first + (row.count > 1 ? j : 0);
    const std::uint32_t b = row.first + (row.count > 1 ? j + 1 : 0);
    const std::uint32_t c = next.first + (next.count > 1 ? j : 0);
    const std::uint32_t d = next.first + (next.count > 1 ? j + 1 : 0);
    if (a == b) {
      mesh.triangles.push_back({a, c, d});
    } else if (c == d) {
      mesh.triangles.push_back({a, c, b});
    } else if ((mesh.positions_m[a] - mesh.positions_m[d]).squaredNorm() <
               (mesh.positions_m[b] - mesh.positions_m[c]).squaredNorm()) {
      mesh.triangles.push_back({a, c, d});
      mesh.triangles.push_back({a, d, b});
    } else {
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  }
}

}  // namespace bpms
