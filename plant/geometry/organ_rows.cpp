#include "plant/geometry/organ_rows.h"

#include "plant/geometry/swept_body.h"
#include "plant/language/attributes.h"
#include "plant/leaf_frame.h"

namespace bpms {

Mesh::Organ::Named organ_parameters(const OrganAttributes& attributes, const std::string& unit) {
  Mesh::Organ::Named out;
  for (const AttributeLine& line : attribute_lines(attributes, unit))
    out.emplace_back(line.name, line.unit.empty() ? line.value : line.value + " " + line.unit);
  return out;
}

void split_senescent(Mesh& mesh, std::size_t first_triangle, const OrganAttributes& leaf) {
  if (leaf.senescent <= 0) return;
  const std::string material = leaf.senescent_material.empty() ? "senescent" : leaf.senescent_material;
  if (leaf.senescent >= 1) {
    mesh.organs.back().material = material;
    return;
  }
  const auto green_index = static_cast<std::uint32_t>(mesh.organs.size() - 1);
  Mesh::Organ dead = mesh.organs.back();
  dead.material = material;
  dead.length_m = leaf.length_m * leaf.senescent;
  dead.area_m2 = 0;
  Mesh::Organ& green = mesh.organs.back();
  green.length_m = leaf.length_m - dead.length_m;
  green.area_m2 = 0;
  const double cut = 1 - leaf.senescent;
  for (std::size_t t = first_triangle; t < mesh.triangles.size(); ++t) {
    // The leaf has a row of vertices at the cut: no triangle lies on both sides.
    double u = 0;
    for (const std::uint32_t vertex : mesh.triangles[t]) u += static_cast<double>(mesh.uv[vertex].x()) / 3;
    const bool is_dead = u > cut;
    if (is_dead) mesh.organ_of_triangle[t] = green_index + 1;
    (is_dead ? dead : green).area_m2 += triangle_area_m2(mesh, t);
  }
  mesh.organs.push_back(std::move(dead));
}

void add_joint(OrganMesh& stem_mesh, const OrganAttributes& stem, double tolerance_m) {
  const double radius_m = joint_radius_m(stem);
  if (radius_m <= 0) return;
  OrganAttributes ball;
  ball.radius_m = radius_m;
  const OrganMesh sphere = swept_mesh(OrganKind::bud, ball, tolerance_m);
  const MidribPoint tip = midrib(stem, {1.0}).back();
  const auto first = static_cast<std::uint32_t>(stem_mesh.positions_m.size());
  for (std::size_t i = 0; i < sphere.positions_m.size(); ++i) {
    // A bud sits on its base: its centre comes to the tip.
    const Eigen::Vector3d from_centre = sphere.positions_m[i] - Eigen::Vector3d(0, 0, radius_m);
    stem_mesh.add(tip.x_m + tip.frame * from_centre, tip.frame * sphere.normals[i], 1, sphere.uv[i].y());
  }
  for (const auto& corners : sphere.triangles)
    stem_mesh.triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
}

}  // namespace bpms
