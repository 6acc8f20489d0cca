// Parts of a prototype and their sizes.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/units.h"
#include "scene/pictures/subject.h"

namespace bpms {
namespace {

// Means over a surface, weighted by area.
struct AreaMeans {
  double area = 0, height = 0, angle = 0;
  void add(double weight, double z, double angle_of) {
    area += weight, height += weight * z, angle += weight * angle_of;
  }
  void give(PicturePart& part) const {
    const double none = std::nan("");
    part.height_m = area > 0 ? height / area : none;
    part.inclination_deg = area > 0 ? degrees(angle / area) : none;
  }
};

double angle_from_horizontal(double normal_z) {
  return std::acos(std::min(1.0, std::abs(normal_z)));
}

void add_organs(const Scene& scene, const Prototype& prototype, std::vector<PicturePart>& out) {
  const Mesh& mesh = *prototype.mesh;
  std::vector<AreaMeans> means(mesh.organs.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Eigen::Vector3d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = mesh.positions_m[mesh.triangles[t][k]].cast<double>();
    const Eigen::Vector3d across = 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    const double area = across.norm();
    if (!(area > 0)) continue;
    means[mesh.organ_of_triangle[t]].add(area, (corner[0].z() + corner[1].z() + corner[2].z()) / 3,
                                         angle_from_horizontal(across.z() / area));
  }
  for (std::size_t k = 0; k < mesh.organs.size(); ++k) {
    const Mesh::Organ& organ = mesh.organs[k];
    PicturePart part{organ.label,
                     organ.kind,
                     scene.materials[prototype.material_of_organ[k]],
                     organ.length_m,
                     organ.area_m2,
                     0,
                     0,
                     organ.properties,
                     organ.parameters};
    means[k].give(part);
    if (!(part.length_m > 0)) part.length_m = std::nan("");
    out.push_back(std::move(part));
  }
}

void add_discs(const Scene& scene, const Prototype& prototype, PictureParts& out) {
  std::map<std::uint32_t, std::uint32_t> part_of_material;
  std::vector<AreaMeans> means;
  const std::size_t first = out.parts.size();
  for (std::size_t k = 0; k < prototype.discs.size(); ++k) {
    const Disc& disc = prototype.discs[k];
    const std::uint32_t material =
        prototype.material_of_disc.empty() ? prototype.disc_material : prototype.material_of_disc[k];
    const auto part = part_of_material.try_emplace(material, static_cast<std::uint32_t>(first + means.size()))
                          .first->second;
    if (part - first == means.size()) {
      means.emplace_back();
      out.parts.push_back({scene.materials[material] + " discs",
                           "disc",
                           scene.materials[material],
                           std::nan(""),
                           0,
                           0,
                           0,
                           {},
                           {}});
    }
    const double radius = disc.radius_m;
    means[part - first].add(pi * radius * radius, disc.centre_m.z(),
                            angle_from_horizontal(static_cast<double>(disc.normal.z())));
    out.part_of_disc.push_back(part);
  }
  for (std::size_t k = 0; k < means.size(); ++k) {
    out.parts[first + k].area_m2 = means[k].area;
    means[k].give(out.parts[first + k]);
  }
}

void add_shapes(const Scene& scene, const Prototype& prototype, PictureParts& out) {
  out.first_shape = static_cast<std::uint32_t>(out.parts.size());
  int number = 0;
  for (const Shape& shape : prototype.shapes) {
    Eigen::Vector3d middle, half;
    shape_box(shape, middle, half);
    const bool solid = shape.kind == Shape::Kind::ellipsoid;
    out.parts.push_back({(solid ? "ellipsoid " : "cylinder ") + std::to_string(++number),
                         "shape",
                         scene.materials[shape.material],
                         solid ? std::nan("") : static_cast<double>(shape.size_m.z()),
                         shape_area_m2(shape),
                         middle.z(),
                         std::nan(""),
                         {},
                         {}});
  }
}

}  // namespace

PictureParts picture_parts(const Scene& scene, const Prototype& prototype) {
  PictureParts out;
  if (prototype.mesh) add_organs(scene, prototype, out.parts);
  add_discs(scene, prototype, out);
  add_shapes(scene, prototype, out);
  return out;
}

std::uint32_t part_of_hit(const PictureParts& parts, const Scene& scene, const Hit& hit) {
  constexpr std::uint32_t shape_geometry = 3, parts_of_shape = 4;
  if (hit.id.geometry == shape_geometry) return parts.first_shape + hit.id.primitive / parts_of_shape;
  if (hit.organ != 0xffffffffu) return hit.organ;
  // Discs are numbered in the intersector's own order: they are told by their material.
  for (std::uint32_t k = 0; k < parts.parts.size(); ++k)
    if (parts.parts[k].kind == "disc" && parts.parts[k].material == scene.materials[hit.material]) return k;
  return 0;
}

}  // namespace bpms
