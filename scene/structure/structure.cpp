#include "scene/structure/structure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"
#include "scene/intersect/box.h"

namespace bpms {
namespace {

// For the sums over facets a disc is a triangle of its area and normal; where it lies does not matter. One
// organ a material.
Mesh disc_facets(const Prototype& prototype, const std::vector<std::string>& materials) {
  Mesh out;
  std::map<std::uint32_t, std::uint32_t> organ_of_material;
  for (std::size_t k = 0; k < prototype.discs.size(); ++k) {
    const Disc& disc = prototype.discs[k];
    const std::uint32_t material =
        prototype.material_of_disc.empty() ? prototype.disc_material : prototype.material_of_disc[k];
    const auto organ =
        organ_of_material.emplace(material, static_cast<std::uint32_t>(out.organs.size())).first->second;
    if (organ == out.organs.size()) out.organs.push_back({0, "discs", "leaf", materials[material], 0, 0});
    const Eigen::Vector3d n = disc.normal.cast<double>();
    const Eigen::Vector3d a = n.unitOrthogonal();
    const Eigen::Vector3d b = n.cross(a);
    // An equilateral triangle of circumradius R has the area 3 sqrt(3) / 4 R^2.
    const double r = disc.radius_m;
    const double circumradius = r * std::sqrt(pi / (0.75 * std::sqrt(3.0)));
    const auto first = static_cast<std::uint32_t>(out.positions_m.size());
    for (int corner = 0; corner < 3; ++corner) {
      const double t = 2 * pi * corner / 3;
      out.positions_m.push_back((circumradius * (std::cos(t) * a + std::sin(t) * b)).cast<float>());
      out.normals.push_back(disc.normal);
    }
    out.triangles.push_back({first, first + 1, first + 2});
    out.organ_of_triangle.push_back(organ);
    out.organs[organ].area_m2 += pi * r * r;
  }
  return out;
}

double nearest_g(const FacetStructure& facets, double zenith_deg) {
  for (const auto& point : facets.g_function)
    if (std::abs(point.zenith_deg - zenith_deg) < 1e-9) return point.g;
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

CanopyStructure canopy_structure(const Scene& scene, const GapOptions& options) {
  CanopyStructure out;
  std::vector<double> area_factor(scene.prototypes.size(), 0), height_factor(scene.prototypes.size(), 0);
  Box box;
  std::vector<Box> own;
  for (const Prototype& prototype : scene.prototypes) own.push_back(bounds(prototype));
  for (const Instance& instance : scene.instances) {
    area_factor[instance.prototype] += instance.scale * instance.scale;
    height_factor[instance.prototype] = std::max(height_factor[instance.prototype], instance.scale);
    box.include(bounds(own[instance.prototype], instance));
  }
  std::vector<Mesh> discs;
  discs.reserve(scene.prototypes.size());
  std::vector<WeightedMesh> meshes;
  std::map<std::string, double> solids, bodies;
  for (std::size_t p = 0; p < scene.prototypes.size(); ++p) {
    const Prototype& prototype = scene.prototypes[p];
    if (area_factor[p] == 0) continue;
    if (!prototype.discs.empty()) {
      discs.push_back(disc_facets(prototype, scene.materials));
      meshes.push_back({&discs.back(), area_factor[p], height_factor[p]});
      for (const Mesh::Organ& organ : discs.back().organs)
        out.material_area_m2[organ.material] += organ.area_m2 * area_factor[p];
    }
    std::vector<bool> solid(prototype.mesh ? prototype.mesh->organs.size() : 0, false);
    for (std::size_t k = 0; k < prototype.shapes.size(); ++k) {
      const Shape& shape = prototype.shapes[k];
      if (const std::uint32_t organ = prototype.organ_of(k); organ != no_organ)
        solid[organ] = true;
      else
        solids[scene.materials[shape.material]] += shape_area_m2(shape) * area_factor[p];
    }
    // Organs of shapes have no triangles that the facets' sums would find.
    for (std::size_t k = 0; k < solid.size(); ++k)
      if (const Mesh::Organ& organ = prototype.mesh->organs[k]; solid[k])
        bodies[organ.material] += organ.area_m2 * area_factor[p];
    if (prototype.mesh) {
      meshes.push_back({prototype.mesh.get(), area_factor[p], height_factor[p]});
      for (std::size_t k = 0; k < prototype.mesh->organs.size(); ++k)
        out.material_area_m2[scene.materials[prototype.material_of_organ[k]]] +=
            prototype.mesh->organs[k].area_m2 * area_factor[p];
    }
  }
  // The lowest point that gap fractions are looked at from, and the height above it.
  Ground level = scene.ground.value_or(Ground{});
  if (!scene.ground && !box.empty()) level.height_m = std::min(0.0, box.low.z());
  double lowest = scene.ground ? level.height_m : 0;
  if (level.terrain)
    lowest = *std::min_element(level.terrain->heights_m.begin(), level.terrain->heights_m.end());
  if (!box.empty()) out.height_m = box.high.z() - lowest;
  out.facets = facet_structure(meshes, usual_zenith_angles_deg());
  for (const auto& [material, area] : bodies) out.facets.other_area_m2[material] += area;
  for (const auto& [material, area] : solids) {
    out.facets.other_area_m2[material] += area;
    out.material_area_m2[material] += area;
  }
  const Footprint footprint(scene);
  out.ground_area_m2 = footprint.area_m2();
  out.ground_is_domain = footprint.is_domain();
  if (!(out.ground_area_m2 > 0)) return out;
  out.lai = out.facets.total_leaf_area_m2 / out.ground_area_m2;
  const Intersector intersector(scene);
  out.gaps = gap_fraction(intersector, footprint, level, usual_gap_angles_deg(), options);
  for (const Gap& gap : out.gaps) {
    const double g = nearest_g(out.facets, gap.zenith_deg);
    if (!scene.domain.periodic || !(gap.p > 0) || !(g * out.lai > 0)) continue;
    const double scale = std::cos(radians(gap.zenith_deg)) / (g * out.lai);
    out.clumping.push_back({gap.zenith_deg, -std::log(gap.p) * scale, gap.standard_error / gap.p * scale});
  }
  return out;
}

}  // namespace bpms
