// The surface of a scene as it stands, summed over its facets: areas, how they are turned, at what height.
//
// Areas are one-sided for leaves, of all the surface for the rest. The plant area counts leaves one-sided and
// half of the rest's surface, so that for convex bodies its projections are those that light meets. Heights
// are above the ground below a facet, or above its plant's base where a terrain carries too many facets.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "plant/structure/height_profile.h"
#include "plant/structure/orientation.h"
#include "scene/scene.h"

namespace bpms {

struct SurfaceSums {
  double leaf_area_m2 = 0, stem_area_m2 = 0, other_area_m2 = 0;
  double plant_area_m2() const { return leaf_area_m2 + 0.5 * (stem_area_m2 + other_area_m2); }
  struct OfMaterial {
    double leaf_m2 = 0, other_m2 = 0;
  };
  std::map<std::string, OfMaterial> materials;
  FacetOrientation leaves, others;  // others: all their surface
  std::map<std::string, FacetOrientation> leaves_of_material;
  HeightProfile leaf_profile, other_profile;

  // G of leaves alone, or of leaves and half of the rest together; NaN where there are none.
  double leaf_g(double zenith) const;
  double plant_g(double zenith) const;
  double leaf_g(double zenith, double azimuth) const;
  double plant_g(double zenith, double azimuth) const;
};

struct SurfaceSumsOptions {
  double height_m = 1;      // of the highest layer's top
  std::size_t layers = 20;  // of the profiles
  // Facets of a prototype times instances of it: up to so many are looked at where they stand, one by one;
  // beyond, the prototype is summed once (its turns in steps of 2 degrees, its heights in 400 layers).
  double most_turned = 3e5, most_raised = 2e7;
};
SurfaceSums surface_sums(const Scene& scene, const Ground& ground, const SurfaceSumsOptions& options);

}  // namespace bpms
