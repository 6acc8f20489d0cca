#include "plant/plant_mesh.h"

#include "plant/geometry/mesh_parts.h"
#include "plant/geometry/organ_rows.h"
#include "plant/mesh.h"

namespace bpms {

double triangle_area_m2(const Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3d p = mesh.positions_m[a].cast<double>();
  return (mesh.positions_m[b].cast<double>() - p).cross(mesh.positions_m[c].cast<double>() - p).norm() / 2;
}

Mesh plant_mesh(const Plant& plant, const MeshOptions& options) {
  Mesh out;
  for (const PlacedOrgan& organ : place_organs(plant)) {
    const OrganAttributes& attributes = *organ.attributes;
    OrganMesh part = organ.kind == OrganKind::leaf ? leaf_mesh(attributes, options.tolerance_m)
                                                   : swept_mesh(organ.kind, attributes, options.tolerance_m);
    if (attributes.joint > 0) add_joint(part, attributes, options.tolerance_m);
    const std::size_t first_triangle = out.triangles.size();
    const auto first = static_cast<std::uint32_t>(out.positions_m.size());
    const auto index = static_cast<std::uint32_t>(out.organs.size());
    for (std::size_t i = 0; i < part.positions_m.size(); ++i) {
      out.positions_m.push_back((organ.plant_from_organ * part.positions_m[i]).cast<float>());
      out.normals.push_back((organ.plant_from_organ.linear() * part.normals[i]).cast<float>());
      out.uv.push_back(part.uv[i].cast<float>());
    }
    Mesh::Organ row;
    row.id = organ.id;
    row.label = organ.label;
    row.kind = organ_name(organ.kind);
    row.material = attributes.material.empty() ? row.kind : attributes.material;
    row.length_m = organ.kind == OrganKind::bud ? 2 * attributes.radius_m : attributes.length_m;
    for (const auto& [a, b, c] : part.triangles) {
      out.triangles.push_back({first + a, first + b, first + c});
      const double area = triangle_area_m2(out, out.triangles.size() - 1);
      if (area == 0) {  // collapsed by single precision: no surface, and no normal to shade it by
        out.triangles.pop_back();
        continue;
      }
      row.area_m2 += area;
      out.organ_of_triangle.push_back(index);
    }
    row.properties = organ.properties;
    if (options.parameters) row.parameters = organ_parameters(attributes, plant.unit);
    out.organs.push_back(std::move(row));
    split_senescent(out, first_triangle, attributes);
  }
  return out;
}

}  // namespace bpms
