// The structure report of a scene: areas, leaf angles and G from its facets, gaps and clumping from rays.
// Ground area: the domain's, or for what stands alone the convex hull of its plan view. Discs count as
// leaves, one-sided.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "plant/structure.h"
#include "scene/scene.h"
#include "scene/structure/gap_fraction.h"

namespace bpms {

struct Clumping {
  double zenith_deg = 0;
  double index = 0;  // -ln P cos(zenith) / (G LAI); 1: random, below: clumped
  double standard_error = 0;
};

struct CanopyStructure {
  FacetStructure facets;
  double ground_area_m2 = 0;
  bool ground_is_domain = true;
  double lai = 0;
  double height_m = 0;  // above the ground, or above z = 0 without one
  std::vector<Gap> gaps;
  std::vector<Clumping> clumping;                  // periodic canopies, where P > 0 and there are leaves
  std::map<std::string, double> material_area_m2;  // by the scene's material names
};
CanopyStructure canopy_structure(const Scene& scene, const GapOptions& options = {});

}  // namespace bpms
