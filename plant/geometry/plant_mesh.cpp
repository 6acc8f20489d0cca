#include "plant/plant_mesh.h"

#include "plant/geometry/mesh_parts.h"
#include "plant/geometry/swept_body.h"
#include "plant/mesh.h"

namespace bpms {
namespace {

double area_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return (b - a).cross(c - a).norm() / 2;
}

Mesh::Organ organ_row(const PlacedOrgan& organ) {
  const OrganAttributes& attributes = *organ.attributes;
  Mesh::Organ row;
  row.id = organ.id;
  row.label = organ.label;
  row.kind = organ_name(organ.kind);
  row.material = attributes.material.empty() ? row.kind : attributes.material;
  row.length_m = organ.kind == OrganKind::bud ? 2 * attributes.radius_m : attributes.length_m;
  return row;
}

// The sum of its triangles' centroids by their areas.
void append_organ(const OrganMesh& part, const Eigen::Isometry3d& place, std::uint32_t index,
                  Mesh::Organ& row, Mesh& out) {
  const auto first = static_cast<std::uint32_t>(out.positions_m.size());
  for (std::size_t i = 0; i < part.positions_m.size(); ++i) {
    out.positions_m.push_back((place * part.positions_m[i]).cast<float>());
    out.normals.push_back((place.linear() * part.normals[i]).cast<float>());
    out.uv.push_back(part.uv[i].cast<float>());
  }
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const auto& corners : part.triangles) {
    const std::array<std::uint32_t, 3> triangle{first + corners[0], first + corners[1], first + corners[2]};
    const Eigen::Vector3d a = out.positions_m[triangle[0]].cast<double>();
    const Eigen::Vector3d b = out.positions_m[triangle[1]].cast<double>();
    const Eigen::Vector3d c = out.positions_m[triangle[2]].cast<double>();
    const double area = area_of(a, b, c);
    if (area == 0) continue;  // collapsed by single precision: no surface, and no normal to shade it by
    out.triangles.push_back(triangle);
    out.organ_of_triangle.push_back(index);
    row.area_m2 += area;
    moment += area / 3 * (a + b + c);
  }
  if (row.area_m2 > 0) row.centroid_m = moment / row.area_m2;
}

}  // namespace

double triangle_area_m2(const Mesh& mesh, std::size_t triangle) {
  const auto& corners = mesh.triangles[triangle];
  return area_of(mesh.positions_m[corners[0]].cast<double>(), mesh.positions_m[corners[1]].cast<double>(),
                 mesh.positions_m[corners[2]].cast<double>());
}

Mesh plant_mesh(const Plant& plant, const MeshOptions& options) {
  Mesh out;
  const std::vector<PlacedOrgan> organs = place_organs(plant);
  out.organs.reserve(organs.size());
  for (const PlacedOrgan& organ : organs) {
    const auto index = static_cast<std::uint32_t>(out.organs.size());
    Mesh::Organ& row = out.organs.emplace_back(organ_row(organ));
    const bool sheet = organ.kind == OrganKind::leaf;
    const OrganMesh part = sheet ? leaf_mesh(*organ.attributes, options.tolerance_m)
                                 : swept_mesh(organ.kind, *organ.attributes, options.tolerance_m);
    append_organ(part, organ.plant_from_organ, index, row, out);
    if (sheet) continue;
    const MassProperties mass = swept_mass(swept_body(organ.kind, *organ.attributes));
    row.volume_m3 = mass.volume_m3;
    row.centroid_m = organ.plant_from_organ * mass.centroid_m;
  }
  return out;
}

}  // namespace bpms
