#include "simulate/output/flux_output.h"

#include <fmt/format.h>

#include <cmath>

#include "core/csv.h"
#include "simulate/output/quantity.h"

namespace bpms {
namespace {

// In the file-format's word: absorbed, by whatever `of` says.
std::string quantity_of(Flux flux) {
  switch (flux) {
    case Flux::absorbed_material:
    case Flux::absorbed_organ:
    case Flux::absorbed_plant:
    case Flux::absorbed_layer:
      return "absorbed";
    default:
      return name_of(flux);
  }
}

std::string rounded(double value, int significant) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, significant) : std::string();
}

// The rows of one flux, in their order.
std::vector<std::size_t> rows_with(const FluxResult& result, Flux flux) {
  std::vector<std::size_t> out;
  for (std::size_t r = 0; r < result.rows.size(); ++r)
    if (result.rows[r].flux == flux) out.push_back(r);
  return out;
}

// Of these origins; more than one make the last dimension.
void write_variable(const FluxResult& result, const std::vector<std::size_t>& origins,
                    const std::vector<std::size_t>& rows, const std::vector<std::string>& dimensions,
                    std::size_t bands, NetcdfWriter& file, const std::string& name,
                    const std::string& words) {
  std::vector<double> value, error;
  for (const std::size_t row : rows)
    for (std::size_t b = 0; b < bands; ++b)
      for (const std::size_t origin : origins) {
        value.push_back(result.fraction[origin].value[row * bands + b]);
        error.push_back(result.fraction[origin].standard_error[row * bands + b]);
      }
  file.variable(name, dimensions, value,
                {{"units", "1"},
                 {"long_name", words},
                 {"coordinates", "wavelength"},
                 {"ancillary_variables", name + "_se"}});
  file.variable(name + "_se", dimensions, error,
                {{"units", "1"}, {"long_name", "standard error of " + words}, {"coordinates", "wavelength"}});
}

}  // namespace

std::string flux_csv_rows(const Simulation& simulation, const FluxSensor& sensor, const FluxResult& result) {
  std::string out;
  const std::size_t bands = simulation.bands.written();
  const Sun* sun = sun_of(simulation.light);
  for (std::size_t o = 0; o < result.origins.size(); ++o)
    for (std::size_t r = 0; r < result.rows.size(); ++r) {
      const FluxRow& row = result.rows[r];
      if (row.flux == Flux::ground_irradiance) continue;
      for (std::size_t b = 0; b < bands; ++b)
        out +=
            fmt::format("{},{},{},{},{},{},,,{},,,{},{},{}\n", quantity_of(row.flux), csv_field(sensor.name),
                        b + 1, csv_number(simulation.bands.written_nm(b)),
                        csv_number(sun != nullptr ? sun->zenith_deg : no_value),
                        csv_number(sun != nullptr ? sun->azimuth_deg : no_value), name_of(result.origins[o]),
                        csv_field(row.of), rounded(result.fraction[o].value[r * bands + b], 7),
                        rounded(result.fraction[o].standard_error[r * bands + b], 3));
    }
  return out;
}

void write_fluxes(const Simulation& simulation, const FluxResult& result, NetcdfWriter& file,
                  const std::string& prefix) {
  const std::size_t bands = simulation.bands.written();
  struct Kind {
    Flux flux;
    const char* dimension;  // null: one row
    const char* name;
    const char* words;
  };
  constexpr Kind kinds[] = {
      {Flux::reflected, nullptr, "reflected", "fraction of the entering power that leaves through the top"},
      {Flux::transmitted, nullptr, "transmitted", "downward flux at the ground over the entering power"},
      {Flux::transmitted_first, nullptr, "transmitted_first",
       "the same before the ground has reflected any of it"},
      {Flux::transmitted_direct, nullptr, "transmitted_direct", "the same before anything has scattered it"},
      {Flux::lost_sides, nullptr, "lost_sides", "fraction that leaves through the sides"},
      {Flux::lost_wraps, nullptr, "lost_wraps", "fraction ended by the wrap limit"},
      {Flux::absorbed_canopy, nullptr, "absorbed_canopy",
       "fraction absorbed by all but the ground (fAPAR by band)"},
      {Flux::absorbed_ground, nullptr, "absorbed_ground", "fraction absorbed by the ground"},
      {Flux::absorbed_material, "absorber", "absorbed", "fraction absorbed by material"},
      {Flux::absorbed_organ, "organ", "absorbed_organ", "fraction absorbed by organ"},
      {Flux::absorbed_plant, "plant", "absorbed_plant", "fraction absorbed by plant"},
      {Flux::absorbed_layer, "layer", "absorbed_layer", "fraction absorbed by layer"},
  };
  for (const Kind& kind : kinds) {
    const std::vector<std::size_t> rows = rows_with(result, kind.flux);
    if (rows.empty()) continue;
    std::vector<std::string> dimensions;
    if (kind.dimension != nullptr) {
      dimensions.push_back(prefix + kind.dimension);
      std::vector<std::string> names;
      for (const std::size_t row : rows) names.push_back(result.rows[row].of);
      file.dimension(dimensions[0], names.size());
      file.words(dimensions[0], dimensions[0], names, {{"long_name", kind.dimension}});
    }
    dimensions.emplace_back("band");
    write_variable(result, {0}, rows, dimensions, bands, file, prefix + kind.name, kind.words);
    if (result.origins.size() == 1) continue;
    dimensions.emplace_back("origin");
    write_variable(result, {0, 1, 2}, rows, dimensions, bands, file, prefix + kind.name + "_by_origin",
                   std::string(kind.words) + ", of the power from each origin");
  }
  const std::vector<std::size_t> pixels = rows_with(result, Flux::ground_irradiance);
  if (pixels.empty()) return;
  file.dimension(prefix + "y", static_cast<std::size_t>(result.map_px[1]));
  file.dimension(prefix + "x", static_cast<std::size_t>(result.map_px[0]));
  write_variable(
      result, {0}, pixels, {prefix + "y", prefix + "x", "band"}, bands, file, prefix + "ground_irradiance",
      "irradiance of the ground over that above the canopy; rows from the north, columns from the west");
}

Json flux_report(const Simulation& simulation, const FluxSensor& sensor, const FluxResult& result) {
  const std::size_t bands = simulation.bands.written();
  Json rows = Json::array();
  constexpr std::size_t most_rows = 1000;  // of a page
  for (std::size_t o = 0; o < result.origins.size(); ++o)
    for (std::size_t r = 0; r < result.rows.size() && r < most_rows; ++r) {
      const FluxRow& row = result.rows[r];
      if (row.flux == Flux::ground_irradiance) continue;
      Json value = Json::array(), error = Json::array();
      for (std::size_t b = 0; b < bands; ++b) {
        value.push_back(json_number(result.fraction[o].value[r * bands + b]));
        error.push_back(json_number(result.fraction[o].standard_error[r * bands + b]));
      }
      rows.push_back({{"flux", name_of(row.flux)},
                      {"of", row.of},
                      {"origin", name_of(result.origins[o])},
                      {"value", value},
                      {"standard_error", error}});
    }
  Json nm = Json::array();
  for (std::size_t b = 0; b < bands; ++b) nm.push_back(json_number(simulation.bands.written_nm(b)));
  return {{"name", sensor.name},
          {"type", "flux"},
          {"wavelength_nm", nm},
          {"samples", result.samples},
          {"rays", result.rays},
          {"rows", rows},
          {"ground_area_m2", result.ground_area_m2},
          {"stopped_by", result.stopped_by}};
}

}  // namespace bpms
