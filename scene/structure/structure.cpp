#include "scene/structure/structure.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "scene/intersect/box.h"

namespace bpms {
namespace {

// Of the highest point above the ground beneath its plant's base.
double height_above(const Scene& scene, const Ground& ground) {
  std::vector<Box> own;
  for (const Prototype& prototype : scene.prototypes) own.push_back(bounds(prototype));
  double out = 0;
  for (const Instance& instance : scene.instances) {
    const Box box = bounds(own[instance.prototype], instance);
    if (box.empty()) continue;
    out = std::max(out, box.high.z() - ground.height_at(instance.position_m.head<2>().eval()));
  }
  return out;
}

void add_gaps(const GapScene& rays, const StructureOptions& options, CanopyStructure& out) {
  std::vector<double> zenith_deg = options.zenith_deg;
  std::sort(zenith_deg.begin(), zenith_deg.end());
  zenith_deg.erase(std::unique(zenith_deg.begin(), zenith_deg.end()), zenith_deg.end());
  GapOptions gaps = options.gaps;
  // So many rays, or such an error, for the mean over azimuth.
  gaps.rays = std::max(1u, gaps.rays / static_cast<std::uint32_t>(options.sectors));
  gaps.target_se *= std::sqrt(options.sectors);
  out.sectors = options.sectors;
  std::vector<GapDirection> directions = gap_directions(zenith_deg, options.sectors);
  std::vector<Gap> all = gap_fraction(rays, directions, gaps);
  out.gaps = mean_over_azimuth(all, options.sectors);
  if (options.sectors > 1) out.gaps_by_azimuth = std::move(all);
  GapOptions ring_options = options.gaps;
  ring_options.seed += 0x72696e67;  // other rays than those of the angles
  out.rings = gap_fraction(rays, plant_canopy_analyser_rings(), ring_options);
}

EffectiveLai effective_lai(const CanopyStructure& structure, GapOf of) {
  return {miller_lai(structure.gaps, of), plant_canopy_analyser_lai(structure.rings, of),
          lai_from_57(structure.gaps, of)};
}

void add_notes(const Scene& scene, CanopyStructure& out) {
  const SurfaceSums& surface = out.surface;
  if (surface.leaves.empty())
    out.notes.emplace_back("there are no leaves: leaf angles, G and the leaf area index are not defined");
  const double below = surface.leaf_profile.below() + surface.other_profile.below();
  const double all = surface.leaf_area_m2 + surface.stem_area_m2 + surface.other_area_m2;
  constexpr double worth_a_word = 1e-3;
  if (scene.ground && below > worth_a_word * all)
    out.notes.push_back(
        fmt::format("{:.2g} % of the surface lies below the ground, where no ray looks; it counts "
                    "in the areas all the same",
                    100 * below / all));
  const auto blind =
      std::find_if(out.gaps.begin(), out.gaps.end(), [](const Gap& g) { return g.plant.p <= 0; });
  if (blind != out.gaps.end())
    out.notes.push_back(
        fmt::format("no ray found a gap at zenith {:g} degrees: clumping is not told there, and "
                    "the integral over zenith goes on with the last angle that has gaps",
                    blind->zenith_deg()));
}

}  // namespace

std::vector<double> usual_zenith_angles_deg() {
  std::vector<double> out = usual_gap_angles_deg();
  out.push_back(90);
  return out;
}

CanopyStructure canopy_structure(const Scene& scene, const StructureOptions& options) {
  return canopy_structure(scene, GapScene(scene), options);
}

CanopyStructure canopy_structure(const Scene& scene, const GapScene& rays, const StructureOptions& options) {
  CanopyStructure out;
  const Ground& level = rays.level();
  out.periodic = scene.domain.periodic;
  out.height_m = height_above(scene, level);
  out.surface = surface_sums(
      scene, level,
      {.height_m = std::max(out.height_m, 1e-9), .layers = static_cast<std::size_t>(options.layers)});
  out.tables = structure_tables(scene);
  out.ground_area_m2 = rays.footprint().area_m2();
  out.ground_is_domain = rays.footprint().is_domain();
  if (out.ground_area_m2 > 0) {
    out.lai = out.surface.leaf_area_m2 / out.ground_area_m2;
    out.pai = out.surface.plant_area_m2() / out.ground_area_m2;
    add_gaps(rays, options, out);
    out.effective_plant = effective_lai(out, GapOf::plant);
    out.effective_leaves = effective_lai(out, GapOf::leaves);
  }
  if (out.periodic) {
    for (const Gap& gap : out.gaps) {
      const double zenith = gap.direction.zenith;
      Clumping row{gap.zenith_deg(), {}, {}};
      if (out.lai > 0) row.leaves = clumping_index(gap.leaves, zenith, out.surface.leaf_g(zenith), out.lai);
      if (out.pai > 0) row.plant = clumping_index(gap.plant, zenith, out.surface.plant_g(zenith), out.pai);
      if (row.leaves || row.plant) out.clumping.push_back(row);
    }
  }
  add_notes(scene, out);
  return out;
}

}  // namespace bpms
