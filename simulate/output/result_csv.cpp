#include <fmt/format.h>

#include <cmath>

#include "core/csv.h"
#include "simulate/output/derived.h"
#include "simulate/output/flux_output.h"
#include "simulate/output/output.h"
#include "simulate/output/quantity.h"

namespace bpms {
namespace {

std::string digits(double value, int significant) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, significant) : std::string();
}

class CsvRows {
 public:
  CsvRows(const Simulation& simulation, const Sensor& sensor) : simulation_(&simulation), sensor_(&sensor) {}

  // band < 0, order < 0, material < 0: the column does not apply.
  void add(const char* quantity, std::size_t view, int band, const Sun* sun, const std::string& origin,
           const std::string& component, int order, int material, double value, double error) {
    std::string& out = text;
    out += quantity;
    field(csv_field(sensor_->name));
    field(band < 0 ? "" : std::to_string(band + 1));
    field(csv_number(band < 0 ? no_value : simulation_->bands.written_nm(static_cast<std::size_t>(band))));
    field(csv_number(sun != nullptr ? sun->zenith_deg : no_value));
    field(csv_number(sun != nullptr ? sun->azimuth_deg : no_value));
    field(csv_number(sensor_->vza_deg(view)));
    field(csv_number(sensor_->vaa_deg(view)));
    field(origin);
    field(component);
    field(order < 0 ? "" : std::to_string(order));
    field(material < 0 ? "" : csv_field(simulation_->materials[static_cast<std::size_t>(material)].name));
    field(digits(value, 7));
    field(digits(error, 3));
    out += '\n';
  }
  std::string text;

 private:
  void field(const std::string& value) {
    text += ',';
    text += value;
  }
  const Simulation* simulation_;
  const Sensor* sensor_;
};

void add_parts(const Simulation& simulation, const SensorResult& result, std::size_t view, CsvRows& rows) {
  const std::size_t bands = simulation.bands.written();
  for (std::size_t p = 0; p < result.parts.size(); ++p) {
    const Part& part = result.parts[p];
    const bool is_total = part.component == Component::all && part.order == every_order;
    if (bands > split_bands && !is_total) continue;
    const std::vector<double> scale = reflectance_scale(simulation, part.origin, part.sun);
    for (std::size_t band = 0; band < bands; ++band) {
      const std::size_t i = view * bands + band;
      const double value = result.radiance[p].value[i], error = result.radiance[p].standard_error[i];
      const auto add = [&](const char* quantity, double by) {
        rows.add(quantity, view, static_cast<int>(band), sun_of(simulation.light, part), name_of(part.origin),
                 name_of(part.component), part.order, -1, value * by, error * by);
      };
      add(reflectance_quantity(simulation.light, *result.sensor).name, scale[band]);
      if (is_total) add(light_quantity(*result.sensor).name, light_scale(*result.sensor));
    }
  }
}

void add_fractions(const Simulation& simulation, const SensorResult& result, std::size_t view,
                   CsvRows& rows) {
  const auto add = [&](const char* quantity, const Sun* sun, const Estimates& of, std::size_t index,
                       int material) {
    rows.add(quantity, view, -1, sun, "", "", -1, material, of.value[index], of.standard_error[index]);
  };
  add("gap", sun_of(simulation.light), result.gap, view, -1);
  const std::size_t materials = simulation.materials.size(), suns = simulation.light.suns.size();
  for (std::size_t s = 0; s < suns; ++s) {
    const Sun* sun = &simulation.light.suns[s];
    add("bidirectional_gap", sun, result.sunlit_ground, view * suns + s, -1);
    for (std::size_t m = 0; m < materials; ++m) {
      const std::size_t at = (view * suns + s) * materials + m;
      add("fraction_sunlit", sun, result.sunlit, at, static_cast<int>(m));
      add("fraction_shaded", sun, result.shaded, at, static_cast<int>(m));
      add("fraction_lit_behind", sun, result.lit_behind, at, static_cast<int>(m));
    }
  }
}

// What derived.h defines, where it is defined.
struct DerivedQuantities {
  DerivedQuantities(const Simulation& simulation, const Result& result, std::size_t sensor)
      : overlap(overlap_function(simulation, result, sensor)),
        g(effective_g(simulation, result, sensor)),
        gamma(effective_gamma(simulation, result, sensor)) {
    if (!result.diffuse_fraction.empty())
      recombined = recombined_reflectance(simulation, result.sensors[sensor], result.diffuse_fraction);
  }
  Estimates overlap, g, gamma, recombined;
};

void add_derived(const Simulation& simulation, const SensorResult& result, const DerivedQuantities& derived,
                 std::size_t view, CsvRows& rows) {
  const std::size_t suns = simulation.light.suns.size(), bands = simulation.bands.written();
  const auto add = [&](const char* quantity, const Sun* sun, const Estimates& of, std::size_t index,
                       int band) {
    if (index < of.value.size() && std::isfinite(of.value[index]))
      rows.add(quantity, view, band, sun, "", "", -1, -1, of.value[index], of.standard_error[index]);
  };
  add("effective_g", sun_of(simulation.light), derived.g, view, -1);
  for (std::size_t s = 0; s < suns; ++s) {
    const Sun* sun = &simulation.light.suns[s];
    add("overlap", sun, derived.overlap, view * suns + s, -1);
    for (std::size_t band = 0; band < bands; ++band)
      add("effective_gamma", sun, derived.gamma, (view * suns + s) * bands + band, static_cast<int>(band));
  }
  const std::string name = recombined_name(simulation.light, *result.sensor);
  for (std::size_t band = 0; band < bands; ++band)
    add(name.c_str(), sun_of(simulation.light), derived.recombined, view * bands + band,
        static_cast<int>(band));
}

}  // namespace

std::string result_csv(const Simulation& simulation, const Result& result) {
  std::string out =
      "quantity,sensor,band,wavelength_nm,sza_deg,saa_deg,vza_deg,vaa_deg,origin,component,order,material,"
      "value,standard_error\n";
  for (std::size_t i = 0; i < result.sensors.size(); ++i) {
    const SensorResult& sensor = result.sensors[i];
    if (sensor.sensor->is_image()) continue;  // pixels are in the NetCDF
    const DerivedQuantities derived(simulation, result, i);
    CsvRows rows(simulation, *sensor.sensor);
    for (std::size_t view = 0; view < sensor.samples.size(); ++view) {
      if (sensor.samples[view] == 0) continue;
      add_parts(simulation, sensor, view, rows);
      add_fractions(simulation, sensor, view, rows);
      add_derived(simulation, sensor, derived, view, rows);
    }
    out += rows.text;
  }
  for (std::size_t f = 0; f < result.fluxes.size(); ++f)
    out += flux_csv_rows(simulation, simulation.fluxes[f], *result.fluxes[f]);
  return out;
}

std::string derivatives_csv(const Simulation& simulation, const Result& result,
                            const Derivatives& derivatives) {
  std::string out = "quantity,sensor,band,wavelength_nm,vza_deg,vaa_deg,by,value,standard_error\n";
  const std::vector<double> scale = reflectance_scale(simulation, Origin::total);
  const std::size_t factors = derivatives.factors.size();
  for (std::size_t s = 0; s < result.sensors.size(); ++s) {
    const Sensor& sensor = *result.sensors[s].sensor;
    const char* quantity = reflectance_quantity(simulation.light, sensor).name;
    for (std::size_t at = 0; at < derivatives.by_sensor[s].value.size(); ++at) {
      const std::size_t view = at / factors / scale.size(), band = at / factors % scale.size();
      out += fmt::format("{},{},{},{},{},{},{},{},{}\n", quantity, csv_field(sensor.name), band + 1,
                         csv_number(simulation.bands.written_nm(band)), csv_number(sensor.vza_deg(view)),
                         csv_number(sensor.vaa_deg(view)), csv_field(derivatives.factors[at % factors]),
                         digits(derivatives.by_sensor[s].value[at] * scale[band], 7),
                         digits(derivatives.by_sensor[s].standard_error[at] * scale[band], 3));
    }
  }
  return out;
}

}  // namespace bpms
