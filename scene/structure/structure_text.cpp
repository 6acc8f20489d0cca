#include <fmt/format.h>

#include <iterator>

#include "core/units.h"
#include "plant/structure/ellipsoidal.h"
#include "scene/structure/structure_report.h"

namespace bpms {
namespace {

using Out = std::back_insert_iterator<std::string>;

std::string figure(const std::optional<WithError>& of, int digits = 3) {
  return of ? fmt::format("{:.{}f} +- {:.{}f}", of->value, digits, of->standard_error, digits) : "-";
}

void print_areas(Out to, const CanopyStructure& structure) {
  const SurfaceSums& surface = structure.surface;
  fmt::format_to(to, "leaf area    {:.6g} m2 (one-sided)\n", surface.leaf_area_m2);
  if (surface.stem_area_m2 > 0) fmt::format_to(to, "stem area    {:.6g} m2\n", surface.stem_area_m2);
  if (surface.other_area_m2 > 0) fmt::format_to(to, "other area   {:.6g} m2\n", surface.other_area_m2);
  for (const auto& [name, area] : surface.materials)
    fmt::format_to(to, "  {:<20} {:.6g} m2\n", name, area.leaf_m2 + area.other_m2);
  if (structure.ground_area_m2 > 0) {
    fmt::format_to(to, "ground area  {:.6g} m2 ({})\n", structure.ground_area_m2,
                   structure.ground_is_domain ? "domain" : "convex hull of the plan view");
    fmt::format_to(to, "LAI          {:.4g}\n", structure.lai);
    fmt::format_to(to, "PAI          {:.4g} (leaves, and half the surface of the rest)\n", structure.pai);
  }
  fmt::format_to(to, "height       {:.4g} m\n", structure.height_m);
}

void print_angles(Out to, const FacetOrientation& leaves) {
  if (leaves.empty()) {
    fmt::format_to(to, "no leaves: no leaf angles, no G\n");
    return;
  }
  fmt::format_to(
      to, "leaf inclination {:.2f} degrees, sd {:.2f}; ellipsoidal chi {:.3g}; G(0) {:.4f}, G(57.5) {:.4f}\n",
      degrees(leaves.mean_inclination()), degrees(leaves.sd_inclination()),
      ellipsoidal_chi(leaves.mean_inclination()), leaves.g(0), leaves.g(radians(57.5)));
}

void print_gaps(Out to, const CanopyStructure& structure) {
  if (structure.gaps.empty()) return;
  fmt::format_to(
      to, "\nzenith  gap fraction           of leaves alone        clumping of leaves   of the plant\n");
  for (const Gap& gap : structure.gaps) {
    const Clumping* row = nullptr;
    for (const Clumping& c : structure.clumping)
      if (c.zenith_deg == gap.zenith_deg()) row = &c;
    fmt::format_to(to, "{:6.1f}  {:.5f} +- {:.5f}     {:.5f} +- {:.5f}     {:<20} {}\n", gap.zenith_deg(),
                   gap.plant.p, gap.plant.standard_error, gap.leaves.p, gap.leaves.standard_error,
                   row ? figure(row->leaves) : "-", row ? figure(row->plant) : "-");
  }
  const auto miller = [](const EffectiveLai& of) {
    return figure(of.miller ? std::optional(of.miller->lai) : std::nullopt);
  };
  const EffectiveLai &plant = structure.effective_plant, &leaves = structure.effective_leaves;
  fmt::format_to(to, "\neffective LAI     all gaps             gaps of leaves alone\n");
  fmt::format_to(to, "Miller's integral {:<20} {}\n", miller(plant), miller(leaves));
  fmt::format_to(to, "LAI-2000          {:<20} {}\n", figure(plant.analyser), figure(leaves.analyser));
  fmt::format_to(to, "57.5 degrees      {:<20} {}\n", figure(plant.at_57), figure(leaves.at_57));
}

void print_species(Out to, const CanopyStructure& structure) {
  if (structure.tables.species.empty()) return;
  fmt::format_to(to, "\nspecies                  count   leaf area m2   height m   inclination\n");
  constexpr std::size_t most = 20;
  for (std::size_t k = 0; k < structure.tables.species.size(); ++k) {
    const SpeciesRow& row = structure.tables.species[k];
    if (k == most) {
      fmt::format_to(to, "and {} more\n", structure.tables.species.size() - most);
      break;
    }
    fmt::format_to(to, "{:<22} {:>7}   {:>12.6g}   {:>8.4g}   {}\n", row.prototype, row.count,
                   row.leaf_area_m2, row.height_m,
                   row.inclination_deg ? fmt::format("{:.1f}", *row.inclination_deg) : "-");
  }
}

}  // namespace

std::string structure_text(const StructureReport& report) {
  std::string out;
  const Out to(out);
  print_areas(to, *report.structure);
  print_angles(to, report.structure->surface.leaves);
  print_gaps(to, *report.structure);
  print_species(to, *report.structure);
  for (const ScatteringTable& table : report.scattering)
    fmt::format_to(to, "{}integral of Gamma / pi for light from {:g} degrees: {:.5f}\n",
                   table.band.empty() ? "" : table.band + ": ", table.source_zenith_deg, table.integral);
  if (report.fisheye)
    fmt::format_to(to, "fisheye: {:.4f} of the sky's solid angle is seen\n", report.fisheye->gap_share);
  if (report.overlap)
    fmt::format_to(to, "overlap: {:.4f} of the leaf area crosses other plants\n", *report.overlap);
  return out;
}

}  // namespace bpms
