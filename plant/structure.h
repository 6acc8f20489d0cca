// Structure of plants from their triangles: areas, height, leaf angles, the projection function G.
// Leaf angle = zenith angle of a facet's normal, folded to 0..90 degrees; areas are one-sided for leaves,
// total surface for the rest. G(theta) = sum A |n . Omega| / sum A, averaged over all azimuths of Omega (Ross
// 1981).
#pragma once
#include <map>
#include <string>
#include <vector>

#include "plant/mesh.h"

namespace bpms {

// A mesh and how many times it stands in the canopy; `area_factor` = the sum of its instances' squared
// scales.
struct WeightedMesh {
  const Mesh* mesh = nullptr;
  double area_factor = 1;
  double height_factor = 1;  // largest scale among them
};

struct FacetStructure {
  std::map<std::string, double> leaf_area_m2;   // per material, one-sided
  std::map<std::string, double> other_area_m2;  // per material: stems, heads, buds and what else there is
  double total_leaf_area_m2 = 0;
  double height_m = 0;  // of the highest vertex above z = 0

  struct AngleBin {
    double from_deg = 0, to_deg = 0;
    double probability = 0;      // sums to 1 over the bins
    double density_per_deg = 0;  // probability / width: integrates to 1
  };
  std::vector<AngleBin> leaf_angle;  // bins of 5 degrees; empty without leaves
  double mean_leaf_angle_deg = 0;    // area-weighted mean of the facets' angles
  double mean_cos2 = 0;              // area-weighted mean of cos^2

  struct GPoint {
    double zenith_deg = 0;
    double g = 0;
  };
  std::vector<GPoint> g_function;  // at the zenith angles asked for; empty without leaves
};
// Facets of organs of kind "leaf" make the leaf statistics. `zenith_deg`: where G is wanted.
FacetStructure facet_structure(const std::vector<WeightedMesh>& meshes,
                               const std::vector<double>& zenith_deg);
std::vector<double> usual_zenith_angles_deg();  // 0, 5, ... 90 and 57.5

// |n . Omega| averaged over the azimuth, for facet angle theta_l and direction theta (radians).
double mean_projection(double leaf_angle, double zenith);

}  // namespace bpms
