#include "plant/plant_mesh.h"

#include "plant/geometry/mesh_parts.h"
#include "plant/geometry/organ_rows.h"
#include "plant/geometry/swept_body.h"
#include "plant/mesh.h"

namespace bpms {
namespace {

double area_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return (b - a).cross(c - a).norm() / 2;
}

Mesh::Organ organ_row(const PlacedOrgan& organ, const Plant& plant, const MeshOptions& options) {
  const OrganAttributes& attributes = *organ.attributes;
  Mesh::Organ row;
  row.id = organ.id;
  row.label = organ.label;
  row.kind = organ_name(organ.kind);
  row.material = attributes.material.empty() ? row.kind : attributes.material;
  row.length_m = organ.kind == OrganKind::bud ? 2 * attributes.radius_m : attributes.length_m;
  row.properties = organ.properties;
  if (options.parameters) row.parameters = organ_parameters(attributes, plant.unit);
  return row;
}

void append_organ(const OrganMesh& part, const Eigen::Isometry3d& place, std::uint32_t index,
                  Mesh::Organ& row, Mesh& out) {
  const auto first = static_cast<std::uint32_t>(out.positions_m.size());
  for (std::size_t i = 0; i < part.positions_m.size(); ++i) {
    out.positions_m.push_back((place * part.positions_m[i]).cast<float>());
    out.normals.push_back((place.linear() * part.normals[i]).cast<float>());
    out.uv.push_back(part.uv[i].cast<float>());
  }
  for (const auto& corners : part.triangles) {
    const std::array<std::uint32_t, 3> triangle{first + corners[0], first + corners[1], first + corners[2]};
    const double area =
        area_of(out.positions_m[triangle[0]].cast<double>(), out.positions_m[triangle[1]].cast<double>(),
                out.positions_m[triangle[2]].cast<double>());
    if (area == 0) continue;  // collapsed by single precision: no surface, and no normal to shade it by
    out.triangles.push_back(triangle);
    out.organ_of_triangle.push_back(index);
    row.area_m2 += area;
  }
}

// Of the sheets' rows from `first` on, whose triangles are those from `first_triangle` on.
void set_centroids(Mesh& mesh, std::size_t first, std::size_t first_triangle) {
  for (std::size_t t = first_triangle; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const Eigen::Vector3f sum =
        mesh.positions_m[corners[0]] + mesh.positions_m[corners[1]] + mesh.positions_m[corners[2]];
    mesh.organs[mesh.organ_of_triangle[t]].centroid_m += triangle_area_m2(mesh, t) / 3 * sum.cast<double>();
  }
  for (std::size_t k = first; k < mesh.organs.size(); ++k)
    if (mesh.organs[k].area_m2 > 0) mesh.organs[k].centroid_m /= mesh.organs[k].area_m2;
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
    const OrganAttributes& attributes = *organ.attributes;
    const std::size_t index = out.organs.size(), first_triangle = out.triangles.size();
    Mesh::Organ& row = out.organs.emplace_back(organ_row(organ, plant, options));
    const auto append = [&](const OrganMesh& part) {
      append_organ(part, organ.plant_from_organ, static_cast<std::uint32_t>(index), row, out);
    };
    if (organ.kind == OrganKind::leaf) {
      append(leaf_mesh(attributes, options.tolerance_m));
      split_senescent(out, first_triangle, attributes);
      set_centroids(out, index, first_triangle);
      continue;
    }
    const MassProperties mass = organ_mass(organ.kind, attributes);
    row.volume_m3 = mass.volume_m3;
    row.centroid_m = organ.plant_from_organ * mass.centroid_m;
    if (!options.bodies) {
      row.area_m2 = mass.area_m2;
      continue;
    }
    OrganMesh part = swept_mesh(organ.kind, attributes, options.tolerance_m);
    if (attributes.joint > 0) add_joint(part, attributes, options.tolerance_m);
    append(part);
  }
  return out;
}

}  // namespace bpms
