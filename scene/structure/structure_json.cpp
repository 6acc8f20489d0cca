#include <algorithm>
#include <cmath>

#include "core/base64.h"
#include "core/units.h"
#include "plant/structure/beta_angles.h"
#include "plant/structure/ellipsoidal.h"
#include "scene/structure/structure_report.h"

namespace bpms {
namespace {

constexpr std::size_t most_plants = 1000;

Json with_error(const std::optional<WithError>& of) {
  if (!of) return nullptr;
  return {{"value", of->value}, {"standard_error", of->standard_error}};
}

void put(Json& to, const std::string& name, const std::optional<WithError>& of) {
  to[name] = of ? json_number(of->value) : Json(nullptr);
  to[name + "_standard_error"] = of ? json_number(of->standard_error) : Json(nullptr);
}

void put(Json& to, const Gap& gap) {
  to["p"] = gap.plant.p;
  to["standard_error"] = gap.plant.standard_error;
  to["leaves"] = gap.leaves.p;
  to["leaves_standard_error"] = gap.leaves.standard_error;
  to["others"] = gap.others.p;
  to["others_standard_error"] = gap.others.standard_error;
  to["rays"] = gap.rays;
}

Json gaps_json(const CanopyStructure& structure) {
  Json out = Json::array();
  for (const Gap& gap : structure.gaps) {
    Json row{{"zenith_deg", gap.zenith_deg()}};
    put(row, gap);
    out.push_back(row);
  }
  return out;
}

Json gaps_by_azimuth_json(const CanopyStructure& structure, const Domain& domain) {
  Json out = Json::array();
  const SurfaceSums& surface = structure.surface;
  for (const Gap& gap : structure.gaps_by_azimuth) {
    const double middle = gap.direction.azimuth + 0.5 * gap.direction.width, zenith = gap.direction.zenith;
    Json row{{"zenith_deg", gap.zenith_deg()},
             {"azimuth_deg", azimuth_in_convention_deg(middle, domain)},
             {"width_deg", degrees(gap.direction.width)}};
    put(row, gap);
    row["g"] = surface.leaves.empty() ? Json(nullptr) : json_number(surface.leaf_g(zenith, middle));
    std::optional<WithError> leaves, plant;
    if (structure.periodic && structure.lai > 0)
      leaves = clumping_index(gap.leaves, zenith, surface.leaf_g(zenith, middle), structure.lai);
    if (structure.periodic && structure.pai > 0)
      plant = clumping_index(gap.plant, zenith, surface.plant_g(zenith, middle), structure.pai);
    put(row, "clumping_leaves", leaves);
    put(row, "clumping_plant", plant);
    out.push_back(row);
  }
  return out;
}

Json bins_json(const std::vector<AngleBin>& bins) {
  Json out = Json::array();
  for (const AngleBin& bin : bins)
    out.push_back({{"from_deg", bin.from_deg},
                   {"to_deg", bin.to_deg},
                   {"probability", bin.probability},
                   {"density_per_deg", bin.density_per_deg}});
  return out;
}

Json leaf_angle_json(const FacetOrientation& leaves) {
  Json out{{"mean_deg", nullptr},        {"sd_deg", nullptr}, {"mean_cos2", nullptr},
           {"ellipsoidal_chi", nullptr}, {"beta", nullptr},   {"bins", Json::array()}};
  if (leaves.empty()) return out;
  const double mean = leaves.mean_inclination(), sd = leaves.sd_inclination();
  out["mean_deg"] = degrees(mean);
  out["sd_deg"] = degrees(sd);
  out["mean_cos2"] = leaves.mean_cos2();
  out["ellipsoidal_chi"] = ellipsoidal_chi(mean);
  if (const auto beta = fit_beta_angles(mean, sd)) out["beta"] = {{"mu", beta->mu}, {"nu", beta->nu}};
  out["bins"] = bins_json(leaves.inclination_bins());
  return out;
}

Json g_json(const SurfaceSums& surface) {
  Json out = Json::array();
  const bool leaves = !surface.leaves.empty(), any = surface.plant_area_m2() > 0;
  for (const double zenith_deg : usual_zenith_angles_deg()) {
    if (!any) break;
    const double zenith = radians(zenith_deg);
    out.push_back({{"zenith_deg", zenith_deg},
                   {"g", leaves ? Json(surface.leaf_g(zenith)) : Json(nullptr)},
                   {"plant_g", surface.plant_g(zenith)}});
  }
  return out;
}

// G(theta, phi): rows by zenith, columns by azimuth.
Json g_by_azimuth_json(const SurfaceSums& surface, const Domain& domain) {
  Json zeniths = Json::array(), azimuths = Json::array(), rows = Json::array();
  constexpr int zenith_step = 10, azimuth_step = 15;
  for (int azimuth = 0; azimuth < 360; azimuth += azimuth_step) azimuths.push_back(azimuth);
  for (int zenith = 0; zenith <= 90; zenith += zenith_step) {
    zeniths.push_back(zenith);
    Json row = Json::array();
    for (int azimuth = 0; azimuth < 360; azimuth += azimuth_step) {
      const Eigen::Vector3d to = direction_from_angles(pi / 2, radians(azimuth), domain);
      row.push_back(surface.leaf_g(radians(zenith), std::atan2(to.y(), to.x())));
    }
    rows.push_back(row);
  }
  return {{"zenith_deg", zeniths}, {"azimuth_deg", azimuths}, {"g", rows}};
}

Json profile_json(const CanopyStructure& structure) {
  Json out = Json::array();
  const HeightProfile &leaf = structure.surface.leaf_profile, &other = structure.surface.other_profile;
  const double ground = structure.ground_area_m2;
  if (!(ground > 0)) return out;
  double leaf_above = 0, plant_above = 0;
  for (std::size_t k = leaf.layers(); k-- > 0;) {
    const double height = leaf.border(k + 1) - leaf.border(k);
    const double own_leaf = leaf.area(k) / ground, own_plant = own_leaf + 0.5 * other.area(k) / ground;
    leaf_above += own_leaf;
    plant_above += own_plant;
    out.push_back({{"from_m", leaf.border(k)},
                   {"to_m", leaf.border(k + 1)},
                   {"leaf_area_density_per_m", own_leaf / height},
                   {"plant_area_density_per_m", own_plant / height},
                   {"lai", own_leaf},
                   {"pai", own_plant},
                   {"cumulative_lai", leaf_above},
                   {"cumulative_pai", plant_above}});
  }
  std::reverse(out.begin(), out.end());
  return out;
}

Json clumping_json(const CanopyStructure& structure) {
  Json out = Json::array();
  for (const Clumping& row : structure.clumping) {
    Json one{{"zenith_deg", row.zenith_deg}};
    put(one, "leaves", row.leaves);
    put(one, "plant", row.plant);
    out.push_back(one);
  }
  return out;
}

Json effective_json(const EffectiveLai& of) {
  Json miller;
  if (of.miller) {
    miller = with_error(of.miller->lai);
    miller["last_zenith_deg"] = of.miller->last_zenith_deg;
  }
  return {{"miller", miller}, {"lai_2000", with_error(of.analyser)}, {"at_57_5", with_error(of.at_57)}};
}

Json number_or_null(const std::optional<double>& value) {
  return value ? json_number(*value) : Json(nullptr);
}

Json organs_json(const StructureTables& tables) {
  Json out = Json::array();
  for (const OrganRow& row : tables.organs) {
    Json one{{"id", row.id},
             {"label", row.label},
             {"kind", row.kind},
             {"material", row.material},
             {"length_m", json_number(row.length_m)},
             {"area_m2", row.area_m2},
             {"inclination_deg", number_or_null(row.inclination_deg)},
             {"low_m", row.low_m},
             {"high_m", row.high_m},
             {"plant", row.prototype}};
    for (const auto& [name, value] : row.properties) one["properties"][name] = value;
    out.push_back(one);
  }
  return out;
}

Json species_json(const CanopyStructure& structure) {
  Json out = Json::array();
  for (const SpeciesRow& row : structure.tables.species)
    out.push_back({{"species", row.prototype},
                   {"count", row.count},
                   {"leaf_area_m2", row.leaf_area_m2},
                   {"other_area_m2", row.other_area_m2},
                   {"lai", structure.ground_area_m2 > 0 ? Json(row.leaf_area_m2 / structure.ground_area_m2)
                                                        : Json(nullptr)},
                   {"inclination_deg", number_or_null(row.inclination_deg)},
                   {"height_m", row.height_m}});
  return out;
}

Json plants_json(const StructureTables& tables) {
  Json out = Json::array();
  for (const PlantRow& row : tables.plants) {
    if (out.size() == most_plants) break;
    out.push_back({{"plant", row.plant},
                   {"species", row.prototype},
                   {"x_m", row.position_m.x()},
                   {"y_m", row.position_m.y()},
                   {"z_m", row.position_m.z()},
                   {"leaf_area_m2", row.leaf_area_m2},
                   {"other_area_m2", row.other_area_m2},
                   {"height_m", row.height_m}});
  }
  return out;
}

Json scattering_json(const StructureReport& report) {
  if (report.scattering.empty()) return nullptr;
  Json optics = Json::array(), tables = Json::array();
  for (const BandOptics& band : report.bands)
    for (const auto& [material, of] : band.of_material)
      optics.push_back({{"band", band.name},
                        {"material", material},
                        {"reflectance", of.reflectance},
                        {"transmittance", of.transmittance}});
  for (const ScatteringTable& table : report.scattering) {
    Json zenith = Json::array(), azimuth = Json::array(), gamma = Json::array();
    for (const ScatteringRow& row : table.rows) {
      zenith.push_back(row.view_zenith_deg);
      azimuth.push_back(row.relative_azimuth_deg);
      gamma.push_back(row.gamma);
    }
    tables.push_back({{"band", table.band},
                      {"source_zenith_deg", table.source_zenith_deg},
                      {"g", table.g},
                      {"integral", table.integral},
                      {"view_zenith_deg", zenith},
                      {"relative_azimuth_deg", azimuth},
                      {"gamma", gamma}});
  }
  return {{"optics", optics}, {"tables", tables}};
}

Json fisheye_json(const StructureReport& report) {
  if (!report.fisheye) return nullptr;
  Json rings = Json::array();
  for (const int angle : {30, 60}) rings.push_back({{"angle_deg", angle}, {"radius", angle / 90.0}});
  return {{"x_m", report.fisheye_at_m.x()},
          {"y_m", report.fisheye_at_m.y()},
          {"gap_share", report.fisheye->gap_share},
          {"width", report.fisheye->image.width},
          {"height", report.fisheye->image.height},
          {"rings", rings},
          {"data_uri", "data:image/png;base64," + base64(encode_png(report.fisheye->image))}};
}

}  // namespace

double azimuth_in_convention_deg(double counter_clockwise, const Domain& domain) {
  const double deg = degrees(counter_clockwise);
  double out = std::fmod(domain.azimuth_north_clockwise ? 90 - deg : deg, 360.0);
  constexpr double hair = 1e-9;
  if (out < -hair) out += 360;
  return std::abs(out) < hair || std::abs(out - 360) < hair ? 0 : out;
}

std::vector<AngleBin> azimuth_bins_in_convention(const std::vector<AngleBin>& bins, const Domain& domain) {
  std::vector<AngleBin> out = bins;
  for (AngleBin& bin : out) {
    const double width = bin.to_deg - bin.from_deg;
    bin.from_deg = azimuth_in_convention_deg(
        radians(domain.azimuth_north_clockwise ? bin.to_deg : bin.from_deg), domain);
    bin.to_deg = bin.from_deg + width;
  }
  std::sort(out.begin(), out.end(),
            [](const AngleBin& a, const AngleBin& b) { return a.from_deg < b.from_deg; });
  return out;
}

Json structure_json(const StructureReport& report) {
  const CanopyStructure& structure = *report.structure;
  const SurfaceSums& surface = structure.surface;
  const Domain& domain = report.scene->domain;
  const bool ground = structure.ground_area_m2 > 0;
  Json materials = Json::object();
  for (const auto& [name, area] : surface.materials)
    materials[name] = {{"area_m2", area.leaf_m2 + area.other_m2},
                       {"leaf_area_m2", area.leaf_m2},
                       {"other_area_m2", area.other_m2}};
  Json out{{"leaf_area_m2", surface.leaf_area_m2},
           {"stem_area_m2", surface.stem_area_m2},
           {"other_area_m2", surface.other_area_m2},
           {"plant_area_m2", surface.plant_area_m2()},
           {"ground_area_m2", ground ? Json(structure.ground_area_m2) : Json(nullptr)},
           {"ground_area_of", structure.ground_is_domain ? "domain" : "convex_hull"},
           {"lai", ground ? Json(structure.lai) : Json(nullptr)},
           {"pai", ground ? Json(structure.pai) : Json(nullptr)},
           {"height_m", structure.height_m}};
  const Gap* down = nullptr;
  for (const Gap& gap : structure.gaps)
    if (gap.direction.zenith == 0) down = &gap;
  out["cover"] = down ? Json(1 - down->plant.p) : Json(nullptr);
  out["cover_standard_error"] = down ? Json(down->plant.standard_error) : Json(nullptr);
  out["leaf_cover"] = down ? Json(1 - down->leaves.p) : Json(nullptr);
  out["leaf_cover_standard_error"] = down ? Json(down->leaves.standard_error) : Json(nullptr);
  out["gap_fraction"] = gaps_json(structure);
  out["gap_by_azimuth"] = gaps_by_azimuth_json(structure, domain);
  out["azimuth_convention"] = domain.azimuth_north_clockwise ? "north_clockwise" : "east_counterclockwise";
  out["g_function"] = g_json(surface);
  out["g_by_azimuth"] = surface.leaves.empty() ? Json(nullptr) : g_by_azimuth_json(surface, domain);
  out["leaf_angle"] = leaf_angle_json(surface.leaves);
  out["leaf_azimuth"] = bins_json(azimuth_bins_in_convention(surface.leaves.azimuth_bins(), domain));
  out["area_scattering"] = scattering_json(report);
  out["clumping"] = clumping_json(structure);
  out["effective_lai"] = {{"plant", effective_json(structure.effective_plant)},
                          {"leaves", effective_json(structure.effective_leaves)}};
  out["profile"] = profile_json(structure);
  out["fisheye"] = fisheye_json(report);
  out["overlap"] = report.overlap ? Json(*report.overlap) : Json(nullptr);
  out["materials"] = materials;
  out["organs"] = organs_json(structure.tables);
  out["species"] = species_json(structure);
  out["plants"] = plants_json(structure.tables);
  out["plants_total"] = structure.tables.plants.size();
  out["instances"] = report.scene->instances.size();
  out["sampled"] = {"gap_fraction", "gap_by_azimuth", "cover",  "leaf_cover",
                    "clumping",     "effective_lai",  "fisheye"};
  Json notes = report.scene->notes;
  for (const std::string& note : structure.notes) notes.push_back(note);
  out["notes"] = notes;
  return out;
}

}  // namespace bpms
