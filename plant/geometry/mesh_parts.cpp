#include "plant/geometry/mesh_parts.h"

#include "plant/mesh.h"
#include "plant/plant_mesh.h"

namespace bpms {

std::uint32_t OrganMesh::add(const Eigen::Vector3d& position_m, const Eigen::Vector3d& normal, double u,
                             double v) {
  positions_m.push_back(position_m);
  normals.push_back(normal);
  uv.emplace_back(u, v);
  return static_cast<std::uint32_t>(positions_m.size() - 1);
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
    } else if ((mesh.positions_m[a] - mesh.positions_m[d]).norm() <
               (mesh.positions_m[b] - mesh.positions_m[c]).norm()) {
      mesh.triangles.push_back({a, c, d});
      mesh.triangles.push_back({a, d, b});
    } else {
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  }
}

double triangle_area_m2(const Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3d p = mesh.positions_m[a].cast<double>();
  return (mesh.positions_m[b].cast<double>() - p).cross(mesh.positions_m[c].cast<double>() - p).norm() / 2;
}

Mesh plant_mesh(const Plant& plant, const MeshOptions& options) {
  Mesh out;
  for (const PlacedOrgan& organ : place_organs(plant)) {
    const OrganAttributes& attributes = *organ.attributes;
    const OrganMesh part = organ.kind == OrganKind::leaf
                               ? leaf_mesh(attributes, options.tolerance_m)
                               : swept_mesh(organ.kind, attributes, options.tolerance_m);
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
    out.organs.push_back(row);
  }
  return out;
}

}  // namespace bpms
