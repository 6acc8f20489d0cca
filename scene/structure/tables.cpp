#include "scene/structure/tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/units.h"
#include "scene/intersect/box.h"
#include "scene/structure/facets.h"

namespace bpms {
namespace {

// Of one prototype at its own size.
struct OwnSums {
  double leaf_m2 = 0, other_m2 = 0, leaf_angle = 0;  // angle x area
  Box box;
};

void add_organs(const Prototype& prototype, const std::vector<std::string>& materials, OwnSums& own,
                std::vector<OrganRow>& out) {
  const std::size_t count = prototype.mesh ? prototype.mesh->organs.size() : 0;
  struct Angles {
    double area = 0, angle = 0, low = std::numeric_limits<double>::infinity(), high = -low;
  };
  std::vector<Angles> of(count);
  visit_facets(prototype, [&](const Facet& facet) {
    const double area = facet.area_vector.norm();
    const double angle = std::atan2(facet.area_vector.head<2>().norm(), std::abs(facet.area_vector.z()));
    (facet.leaf ? own.leaf_m2 : own.other_m2) += area;
    if (facet.leaf) own.leaf_angle += area * angle;
    if (facet.organ >= count) return;
    Angles& organ = of[facet.organ];
    organ.area += area;
    organ.angle += area * angle;
    for (const Eigen::Vector3d& corner : facet.corners) {
      organ.low = std::min(organ.low, corner.z());
      organ.high = std::max(organ.high, corner.z());
    }
  });
  for (std::size_t k = 0; k < count; ++k) {
    const Mesh::Organ& organ = prototype.mesh->organs[k];
    OrganRow row{prototype.name, organ.label, organ.kind, "", organ.id,        organ.length_m,
                 of[k].area,     {},          0,          0,  organ.properties};
    if (k < prototype.material_of_organ.size()) row.material = materials[prototype.material_of_organ[k]];
    if (organ.kind == "leaf" && of[k].area > 0) row.inclination_deg = degrees(of[k].angle / of[k].area);
    if (of[k].low <= of[k].high) row.low_m = of[k].low, row.high_m = of[k].high;
    out.push_back(std::move(row));
  }
}

}  // namespace

StructureTables structure_tables(const Scene& scene) {
  StructureTables out;
  std::vector<OwnSums> own(scene.prototypes.size());
  std::vector<std::size_t> count(own.size(), 0);
  std::vector<double> factor(own.size(), 0), largest(own.size(), 0);
  for (const Instance& instance : scene.instances) {
    ++count[instance.prototype];
    factor[instance.prototype] += instance.scale * instance.scale;
    largest[instance.prototype] = std::max(largest[instance.prototype], instance.scale);
  }
  for (std::size_t p = 0; p < own.size(); ++p) {
    if (count[p] == 0) continue;
    const Prototype& prototype = scene.prototypes[p];
    own[p].box = bounds(prototype);
    add_organs(prototype, scene.materials, own[p], out.organs);
    SpeciesRow row{prototype.name, count[p], factor[p] * own[p].leaf_m2, factor[p] * own[p].other_m2, {}, 0};
    if (own[p].leaf_m2 > 0) row.inclination_deg = degrees(own[p].leaf_angle / own[p].leaf_m2);
    if (!own[p].box.empty()) row.height_m = largest[p] * own[p].box.high.z();
    out.species.push_back(std::move(row));
  }
  std::map<std::uint32_t, std::size_t> row_of;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const std::uint32_t plant = instance.plant == no_plant ? i : instance.plant;
    const auto [place, is_new] = row_of.try_emplace(plant, out.plants.size());
    const OwnSums& sums = own[instance.prototype];
    if (is_new)
      out.plants.push_back({plant, scene.prototypes[instance.prototype].name, instance.position_m, 0, 0, 0});
    PlantRow& row = out.plants[place->second];
    row.leaf_area_m2 += instance.scale * instance.scale * sums.leaf_m2;
    row.other_area_m2 += instance.scale * instance.scale * sums.other_m2;
    if (!sums.box.empty())
      row.height_m = std::max(row.height_m, bounds(sums.box, instance).high.z() - row.position_m.z());
  }
  return out;
}

}  // namespace bpms
