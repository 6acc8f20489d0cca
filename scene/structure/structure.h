// The structure report of a scene: areas, leaf angles, G and heights from its facets (exact), gaps and what
// follows from them by rays (sampled, with standard errors). Ground area: the domain's, or for what stands
// alone the convex hull of its plan view. Discs count as leaves, one-sided. docs/structure.md has the
// definitions.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/structure/gap_analysis.h"
#include "scene/structure/surface_sums.h"
#include "scene/structure/tables.h"

namespace bpms {

struct StructureOptions {
  std::vector<double> zenith_deg = usual_gap_angles_deg();  // of the gaps, each below 90
  int sectors = 1;                                          // of azimuth
  int layers = 20;                                          // of the profile
  GapOptions gaps;
};

struct Clumping {
  double zenith_deg = 0;
  // Of leaves: gaps of leaves alone, G and LAI. Of the plant: gaps, G and area index of all surfaces. None
  // where there is no gap, or nothing at all.
  std::optional<WithError> leaves, plant;
};

struct EffectiveLai {
  std::optional<MillerIntegral> miller;
  std::optional<WithError> analyser;  // LAI-2000
  std::optional<WithError> at_57;
};

struct CanopyStructure {
  SurfaceSums surface;
  double ground_area_m2 = 0;
  bool ground_is_domain = true;
  bool periodic = false;
  double lai = 0, pai = 0;  // 0 without a ground area
  double height_m = 0;      // above the ground, or above z = 0 (or the lowest point) without one
  int sectors = 1;
  std::vector<Gap> gaps;             // averaged over azimuth, by rising zenith
  std::vector<Gap> gaps_by_azimuth;  // zenith by zenith; empty with one sector
  std::vector<Gap> rings;            // of a plant canopy analyser
  std::vector<Clumping> clumping;    // of periodic canopies: light also enters the sides of others
  EffectiveLai effective_plant, effective_leaves;
  StructureTables tables;
  std::vector<std::string> notes;

  double leaf_area_below_ground_m2() const { return surface.leaf_profile.below(); }
};
CanopyStructure canopy_structure(const Scene& scene, const StructureOptions& options = {});
// With the rays' scene at hand already.
CanopyStructure canopy_structure(const Scene& scene, const GapScene& rays, const StructureOptions& options);

std::vector<double> usual_zenith_angles_deg();  // 0, 5, ... 90 and 57.5: where G is told

}  // namespace bpms
