// One row a number: quantity, what it is of, where it applies.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/csv.h"
#include "core/units.h"
#include "plant/structure/beta_angles.h"
#include "plant/structure/ellipsoidal.h"
#include "scene/structure/structure_report.h"

namespace bpms {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

struct CsvPlace {
  std::string of = "canopy", name;
  double zenith_deg = no_number, azimuth_deg = no_number;
  double from_deg = no_number, to_deg = no_number, from_m = no_number, to_m = no_number;
};

class StructureTable {
 public:
  void add(const std::string& quantity, const CsvPlace& at, double value, double standard_error = no_number) {
    text_ += csv_field(quantity) + ',' + csv_field(at.of) + ',' + csv_field(at.name);
    for (const double number : {at.zenith_deg, at.azimuth_deg, at.from_deg, at.to_deg, at.from_m, at.to_m})
      text_ += ',' + csv_number(number);
    text_ += ',';
    if (std::isfinite(value)) text_ += fmt::format("{:.7g}", value);
    text_ += ',';
    if (std::isfinite(standard_error)) text_ += fmt::format("{:.3g}", standard_error);
    text_ += '\n';
  }
  void add(const std::string& quantity, const CsvPlace& at, const std::optional<WithError>& value) {
    if (value) add(quantity, at, value->value, value->standard_error);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_ =
      "quantity,of,name,zenith_deg,azimuth_deg,from_deg,to_deg,from_m,to_m,value,standard_error\n";
};

void add_gap(StructureTable& out, const CsvPlace& at, const Gap& gap) {
  out.add("gap_fraction", at, gap.plant.p, gap.plant.standard_error);
  out.add("gap_fraction_leaves", at, gap.leaves.p, gap.leaves.standard_error);
  out.add("gap_fraction_others", at, gap.others.p, gap.others.standard_error);
}

void add_angles(StructureTable& out, const FacetOrientation& leaves, const Domain& domain) {
  if (leaves.empty()) return;
  const double mean = leaves.mean_inclination(), sd = leaves.sd_inclination();
  out.add("leaf_angle_mean_deg", {}, degrees(mean));
  out.add("leaf_angle_sd_deg", {}, degrees(sd));
  out.add("leaf_angle_mean_cos2", {}, leaves.mean_cos2());
  out.add("ellipsoidal_chi", {}, ellipsoidal_chi(mean));
  if (const auto beta = fit_beta_angles(mean, sd)) {
    out.add("beta_mu", {}, beta->mu);
    out.add("beta_nu", {}, beta->nu);
  }
  const auto bins = [&](const std::string& name, const std::vector<AngleBin>& of) {
    for (const AngleBin& bin : of) {
      CsvPlace at;
      at.from_deg = bin.from_deg, at.to_deg = bin.to_deg;
      out.add(name + "_probability", at, bin.probability);
      out.add(name + "_density_per_deg", at, bin.density_per_deg);
    }
  };
  bins("leaf_angle", leaves.inclination_bins());
  bins("leaf_azimuth", azimuth_bins_in_convention(leaves.azimuth_bins(), domain));
}

void add_profile(StructureTable& out, const CanopyStructure& structure) {
  const HeightProfile &leaf = structure.surface.leaf_profile, &other = structure.surface.other_profile;
  const double ground = structure.ground_area_m2;
  if (!(ground > 0)) return;
  for (std::size_t k = 0; k < leaf.layers(); ++k) {
    CsvPlace at{"layer", ""};
    at.from_m = leaf.border(k), at.to_m = leaf.border(k + 1);
    const double height = at.to_m - at.from_m;
    out.add("leaf_area_density_per_m", at, leaf.area(k) / ground / height);
    out.add("plant_area_density_per_m", at, (leaf.area(k) + 0.5 * other.area(k)) / ground / height);
  }
}

void add_effective(StructureTable& out, const std::string& of, const EffectiveLai& lai) {
  if (lai.miller)
    out.add("effective_lai_miller", {of, ""}, lai.miller->lai.value, lai.miller->lai.standard_error);
  out.add("effective_lai_2000", {of, ""}, lai.analyser);
  out.add("effective_lai_57_5", {of, ""}, lai.at_57);
}

void add_tables(StructureTable& out, const CanopyStructure& structure) {
  for (const auto& [name, area] : structure.surface.materials) {
    out.add("leaf_area_m2", {"material", name}, area.leaf_m2);
    out.add("other_area_m2", {"material", name}, area.other_m2);
  }
  for (const SpeciesRow& row : structure.tables.species) {
    const CsvPlace at{"species", row.prototype};
    out.add("count", at, static_cast<double>(row.count));
    out.add("leaf_area_m2", at, row.leaf_area_m2);
    out.add("other_area_m2", at, row.other_area_m2);
    out.add("height_m", at, row.height_m);
    if (row.inclination_deg) out.add("leaf_angle_mean_deg", at, *row.inclination_deg);
  }
  for (const PlantRow& row : structure.tables.plants) {
    const CsvPlace at{"plant", fmt::format("{} {}", row.prototype, row.plant)};
    out.add("x_m", at, row.position_m.x());
    out.add("y_m", at, row.position_m.y());
    out.add("leaf_area_m2", at, row.leaf_area_m2);
    out.add("other_area_m2", at, row.other_area_m2);
    out.add("height_m", at, row.height_m);
  }
  for (const OrganRow& row : structure.tables.organs) {
    const CsvPlace at{"organ", fmt::format("{} {}", row.prototype,
                                           row.label.empty() ? fmt::format("{}", row.id) : row.label)};
    out.add("length_m", at, row.length_m);
    out.add("area_m2", at, row.area_m2);
    if (row.inclination_deg) out.add("leaf_angle_mean_deg", at, *row.inclination_deg);
  }
}

}  // namespace

std::string structure_csv(const StructureReport& report) {
  const CanopyStructure& structure = *report.structure;
  const SurfaceSums& surface = structure.surface;
  StructureTable out;
  out.add("leaf_area_m2", {}, surface.leaf_area_m2);
  out.add("stem_area_m2", {}, surface.stem_area_m2);
  out.add("other_area_m2", {}, surface.other_area_m2);
  out.add("height_m", {}, structure.height_m);
  if (structure.ground_area_m2 > 0) {
    out.add("ground_area_m2", {}, structure.ground_area_m2);
    out.add("lai", {}, structure.lai);
    out.add("pai", {}, structure.pai);
  }
  add_angles(out, surface.leaves, report.scene->domain);
  for (const double zenith_deg : usual_zenith_angles_deg()) {
    CsvPlace at;
    at.zenith_deg = zenith_deg;
    if (!surface.leaves.empty()) out.add("g", at, surface.leaf_g(radians(zenith_deg)));
    if (surface.plant_area_m2() > 0) out.add("plant_g", at, surface.plant_g(radians(zenith_deg)));
  }
  for (const Gap& gap : structure.gaps) {
    CsvPlace at;
    at.zenith_deg = gap.zenith_deg();
    add_gap(out, at, gap);
  }
  for (const Gap& gap : structure.gaps_by_azimuth) {
    CsvPlace at;
    at.of = "sector";
    at.zenith_deg = gap.zenith_deg();
    at.azimuth_deg =
        azimuth_in_convention_deg(gap.direction.azimuth + 0.5 * gap.direction.width, report.scene->domain);
    add_gap(out, at, gap);
  }
  for (const Clumping& row : structure.clumping) {
    CsvPlace at;
    at.zenith_deg = row.zenith_deg;
    out.add("clumping_leaves", at, row.leaves);
    out.add("clumping_plant", at, row.plant);
  }
  add_effective(out, "plant", structure.effective_plant);
  add_effective(out, "leaves", structure.effective_leaves);
  add_profile(out, structure);
  for (const ScatteringTable& table : report.scattering) {
    for (const ScatteringRow& row : table.rows) {
      CsvPlace at{"canopy", fmt::format("{} source at {:g} degrees", table.band, table.source_zenith_deg)};
      at.zenith_deg = row.view_zenith_deg;
      at.azimuth_deg = row.relative_azimuth_deg;
      out.add("area_scattering", at, row.gamma);
    }
  }
  add_tables(out, structure);
  return out.take();
}

}  // namespace bpms
