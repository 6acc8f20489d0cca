#include "plant/mesh_part.h"

namespace bpms {

Mesh mesh_part(const Mesh& mesh, const std::function<bool(std::uint32_t organ)>& wanted) {
  Mesh out;
  out.organs = mesh.organs;
  std::vector<char> keep(std::max<std::size_t>(1, mesh.organs.size()));
  for (std::size_t k = 0; k < keep.size(); ++k) keep[k] = wanted(static_cast<std::uint32_t>(k)) ? 1 : 0;
  constexpr std::uint32_t unused = 0xffffffffu;
  std::vector<std::uint32_t> renumbered(mesh.positions_m.size(), unused);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t organ = mesh.organ_of_triangle.empty() ? 0 : mesh.organ_of_triangle[t];
    if (keep[organ] == 0) continue;
    std::array<std::uint32_t, 3> corners = mesh.triangles[t];
    for (std::uint32_t& corner : corners) {
      std::uint32_t& at = renumbered[corner];
      if (at == unused) {
        at = static_cast<std::uint32_t>(out.positions_m.size());
        out.positions_m.push_back(mesh.positions_m[corner]);
        if (!mesh.normals.empty()) out.normals.push_back(mesh.normals[corner]);
        if (!mesh.uv.empty()) out.uv.push_back(mesh.uv[corner]);
      }
      corner = at;
    }
    out.triangles.push_back(corners);
    if (!mesh.organ_of_triangle.empty()) out.organ_of_triangle.push_back(organ);
  }
  return out;
}

}  // namespace bpms
