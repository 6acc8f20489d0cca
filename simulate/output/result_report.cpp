#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base64.h"
#include "core/units.h"
#include "simulate/output/derived.h"
#include "simulate/output/flux_output.h"
#include "simulate/output/output.h"
#include "simulate/output/quantity.h"
#include "simulate/sensors/spherical.h"

namespace bpms {
namespace {

Json wavelength(const Bands& bands, std::size_t band) {
  return json_number(bands.written_nm(band));
}
Json angle_of(const Sun* sun, bool zenith) {
  if (sun == nullptr) return nullptr;
  return zenith ? sun->zenith_deg : sun->azimuth_deg;
}

// Bands that have curves over the views: all of a few; of many those nearest to green, red and infrared.
std::vector<std::size_t> shown_bands(const Bands& bands) {
  std::vector<std::size_t> out;
  for (std::size_t band = 0; band < bands.written() && bands.written() <= split_bands; ++band)
    out.push_back(band);
  if (!out.empty()) return out;
  for (const double nm : {550.0, 670.0, 850.0, 1650.0}) {
    std::size_t nearest = 0;
    for (std::size_t band = 1; band < bands.written(); ++band)
      if (std::abs(bands.written_nm(band) - nm) < std::abs(bands.written_nm(nearest) - nm)) nearest = band;
    if (std::find(out.begin(), out.end(), nearest) == out.end()) out.push_back(nearest);
  }
  return out;
}

struct Curve {
  Json vza = Json::array(), vaa = Json::array(), value = Json::array(), error = Json::array();
};

// Over the views that were traced; stride and offset pick from what is kept per view, scale makes the
// quantity.
Curve curve_over_views(const SensorResult& result, const Estimates& of, std::size_t stride,
                       std::size_t offset, double scale) {
  Curve out;
  for (std::size_t view = 0; view < result.samples.size(); ++view) {
    if (result.samples[view] == 0) continue;
    out.vza.push_back(json_number(result.sensor->vza_deg(view)));
    out.vaa.push_back(json_number(result.sensor->vaa_deg(view)));
    out.value.push_back(json_number(of.value[view * stride + offset] * scale));
    out.error.push_back(json_number(of.standard_error[view * stride + offset] * scale));
  }
  return out;
}

Json series_of(const Sun* sun, const SensorResult& result, const std::string& quantity, Json band, Json nm,
               const Part* part, Json material, const Curve& curve) {
  return {{"sensor", result.sensor->name},
          {"quantity", quantity},
          {"band", std::move(band)},
          {"wavelength_nm", std::move(nm)},
          {"origin", part ? Json(name_of(part->origin)) : Json(nullptr)},
          {"component", part ? Json(name_of(part->component)) : Json(nullptr)},
          {"order", part && part->order != every_order ? Json(part->order) : Json(nullptr)},
          {"material", std::move(material)},
          {"sza_deg", angle_of(sun, true)},
          {"saa_deg", angle_of(sun, false)},
          {"vza_deg", curve.vza},
          {"vaa_deg", curve.vaa},
          {"value", curve.value},
          {"standard_error", curve.error}};
}

void add_series(const Simulation& simulation, const SensorResult& result, Json& out) {
  const std::size_t bands = simulation.bands.written(), materials = simulation.materials.size();
  constexpr int orders_shown = 10;
  for (std::size_t p = 0; p < result.parts.size(); ++p) {
    const Part& part = result.parts[p];
    if (part.order > orders_shown) continue;
    const std::vector<double> scale = reflectance_scale(simulation, part.origin, part.sun);
    for (const std::size_t band : shown_bands(simulation.bands))
      out.push_back(series_of(sun_of(simulation.light, part), result,
                              reflectance_quantity(simulation.light, *result.sensor).name, band + 1,
                              wavelength(simulation.bands, band), &part, nullptr,
                              curve_over_views(result, result.radiance[p], bands, band, scale[band])));
  }
  out.push_back(series_of(sun_of(simulation.light), result, "gap", nullptr, nullptr, nullptr, nullptr,
                          curve_over_views(result, result.gap, 1, 0, 1)));
  const std::size_t suns = simulation.light.suns.size();
  for (std::size_t i = 0; i < suns * materials; ++i) {
    const auto add = [&](const char* quantity, const Estimates& of) {
      out.push_back(series_of(&simulation.light.suns[i / materials], result, quantity, nullptr, nullptr,
                              nullptr, simulation.materials[i % materials].name,
                              curve_over_views(result, of, suns * materials, i, 1)));
    };
    add("fraction_sunlit", result.sunlit);
    add("fraction_shaded", result.shaded);
  }
}

Json numbers_of(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double value : values) out.push_back(json_number(value));
  return out;
}

Json sun_rows(const Simulation& simulation, const Result& result) {
  const Estimates g = effective_g_of_suns(simulation, result);
  Json out = Json::array();
  for (std::size_t s = 0; s < simulation.light.suns.size(); ++s) {
    const Sun& sun = simulation.light.suns[s];
    Json row{{"name", sun.name}, {"sza_deg", sun.zenith_deg}, {"saa_deg", sun.azimuth_deg}};
    const auto put = [&](const std::string& name, const Estimates& of) {
      if (s >= of.value.size()) return;
      row[name] = json_number(of.value[s]);
      row[name + "_standard_error"] = json_number(of.standard_error[s]);
    };
    put("gap", result.sun_gap);
    put("effective_g", g);
    out.push_back(std::move(row));
  }
  return out;
}

void add_derived_series(const Simulation& simulation, const Result& whole, std::size_t sensor, Json& out) {
  const SensorResult& result = whole.sensors[sensor];
  const std::size_t bands = simulation.bands.written(), suns = simulation.light.suns.size();
  const auto add = [&](const std::string& quantity, const Sun* sun, const Estimates& of, std::size_t stride,
                       std::size_t offset, int band) {
    if (of.value.empty()) return;
    const bool by_band = band >= 0;
    const auto at = static_cast<std::size_t>(std::max(0, band));
    out.push_back(series_of(sun, result, quantity, by_band ? Json(at + 1) : Json(nullptr),
                            by_band ? wavelength(simulation.bands, at) : Json(nullptr), nullptr, nullptr,
                            curve_over_views(result, of, stride, offset, 1)));
  };
  const Estimates overlap = overlap_function(simulation, whole, sensor),
                  gamma = effective_gamma(simulation, whole, sensor);
  add("effective_g", sun_of(simulation.light), effective_g(simulation, whole, sensor), 1, 0, -1);
  for (std::size_t s = 0; s < suns; ++s) {
    const Sun* sun = &simulation.light.suns[s];
    add("bidirectional_gap", sun, result.sunlit_ground, suns, s, -1);
    add("overlap", sun, overlap, suns, s, -1);
    for (const std::size_t b : shown_bands(simulation.bands))
      add("effective_gamma", sun, gamma, suns * bands, s * bands + b, static_cast<int>(b));
  }
  if (whole.diffuse_fraction.empty()) return;
  const Estimates recombined = recombined_reflectance(simulation, result, whole.diffuse_fraction);
  for (const std::size_t b : shown_bands(simulation.bands))
    add(recombined_name(simulation.light, *result.sensor), sun_of(simulation.light), recombined, bands, b,
        static_cast<int>(b));
}

// Of a hemispherical image: circles of equal angle to its axis, with radii in those of the image.
Json rings_of(const Sensor& sensor) {
  Json out = Json::array();
  const auto* round = dynamic_cast<const SphericalSensor*>(&sensor);
  for (const double angle_deg : {30.0, 60.0}) {
    if (round == nullptr) break;
    const double radius = round->projection == SphereProjection::equal_angle
                              ? angle_deg / 90
                              : std::numbers::sqrt2 * std::sin(angle_deg * pi / 360);
    out.push_back({{"angle_deg", angle_deg}, {"radius", radius}});
  }
  return out;
}

void add_orders(const Simulation& simulation, const SensorResult& result, Json& out) {
  const std::vector<OrderDecay> decays = order_decay(simulation, result);
  for (const std::size_t band : shown_bands(simulation.bands)) {
    if (band >= decays.size()) continue;
    const OrderDecay& decay = decays[band];
    out.push_back({{"sensor", result.sensor->name},
                   {"quantity", reflectance_quantity(simulation.light, *result.sensor).name},
                   {"band", band + 1},
                   {"wavelength_nm", wavelength(simulation.bands, band)},
                   {"value", numbers_of(decay.value)},
                   {"standard_error", numbers_of(decay.standard_error)},
                   {"ratio", numbers_of(decay.ratio)},
                   {"ratio_standard_error", numbers_of(decay.ratio_standard_error)},
                   {"enough_order", decay.enough_order ? Json(*decay.enough_order) : Json(nullptr)}});
  }
}

void add_spectra(const Simulation& simulation, const SensorResult& result, Json& out) {
  const std::size_t bands = simulation.bands.written();
  if (bands <= split_bands) return;
  const std::vector<double> scale = reflectance_scale(simulation, Origin::total);
  for (std::size_t view = 0; view < result.samples.size(); ++view) {
    if (result.samples[view] == 0) continue;
    Json nm = Json::array(), value = Json::array(), error = Json::array();
    for (std::size_t band = 0; band < bands; ++band) {
      nm.push_back(wavelength(simulation.bands, band));
      value.push_back(json_number(result.radiance[0].value[view * bands + band] * scale[band]));
      error.push_back(json_number(result.radiance[0].standard_error[view * bands + band] * scale[band]));
    }
    out.push_back({{"sensor", result.sensor->name},
                   {"quantity", reflectance_quantity(simulation.light, *result.sensor).name},
                   {"vza_deg", json_number(result.sensor->vza_deg(view))},
                   {"vaa_deg", json_number(result.sensor->vaa_deg(view))},
                   {"sza_deg", angle_of(sun_of(simulation.light), true)},
                   {"wavelength_nm", nm},
                   {"value", value},
                   {"standard_error", error}});
  }
}

Json sensor_summary(const Simulation& simulation, const SensorResult& result) {
  const std::size_t bands = simulation.bands.written();
  double worst = 0;
  std::uint64_t samples = 0;
  Json per_view = Json::array();
  const std::vector<double> scale = reflectance_scale(simulation, Origin::total);
  for (std::size_t view = 0; view < result.samples.size(); ++view) {
    samples += result.samples[view];
    if (!result.sensor->is_image()) per_view.push_back(result.samples[view]);
    for (std::size_t band = 0; band < bands; ++band)
      worst = std::max(worst, result.radiance[0].standard_error[view * bands + band] * scale[band]);
  }
  Json out{{"name", result.sensor->name},
           {"type", result.sensor->type},
           {"views", result.samples.size()},
           {"samples", samples},
           {"rays", result.rays},
           {"lost_paths", result.lost},
           {"largest_standard_error", json_number(worst)}};
  if (!per_view.empty()) out["samples_per_view"] = per_view;
  if (!result.truncation.empty()) {
    double most = 0;
    bool known = false;
    for (std::size_t i = 0; i < result.truncation.size(); ++i) {
      if (!std::isfinite(result.truncation[i])) continue;
      known = true;
      most = std::max(most, result.truncation[i] * scale[i % bands]);
    }
    out["largest_truncation_bias"] = known ? Json(most) : Json(nullptr);
  }
  return out;
}

}  // namespace

Json result_report(const Simulation& simulation, const Result& result) {
  Json sensors = Json::array(), series = Json::array(), spectra = Json::array(), images = Json::array(),
       orders = Json::array();
  for (std::size_t i = 0; i < result.sensors.size(); ++i) {
    const SensorResult& sensor = result.sensors[i];
    sensors.push_back(sensor_summary(simulation, sensor));
    if (sensor.sensor->is_image()) {
      const RgbImage image = quick_look(simulation, sensor);
      images.push_back({{"sensor", sensor.sensor->name},
                        {"caption", sensor.sensor->name + ", " + std::to_string(image.width) + " x " +
                                        std::to_string(image.height)},
                        {"width", image.width},
                        {"height", image.height},
                        {"rings", rings_of(*sensor.sensor)},
                        {"data_uri", "data:image/png;base64," + base64(encode_png(image))}});
    } else {
      add_series(simulation, sensor, series);
      add_derived_series(simulation, result, i, series);
      add_orders(simulation, sensor, orders);
      add_spectra(simulation, sensor, spectra);
    }
  }
  Json fluxes = Json::array();
  for (std::size_t f = 0; f < result.fluxes.size(); ++f)
    fluxes.push_back(flux_report(simulation, simulation.fluxes[f], *result.fluxes[f]));
  Json names = Json::array();  // empty without response functions
  for (std::size_t band = 0; band < simulation.bands.written() && !simulation.bands.responses.empty(); ++band)
    names.push_back(simulation.bands.written_name(band));
  return {{"sensors", sensors},  {"samples", result.samples}, {"seconds", result.seconds},
          {"rays", result.rays}, {"threads", result.threads}, {"stopped_by", result.stopped_by},
          {"seed", result.seed}, {"version", version()},      {"series", series},
          {"spectra", spectra},  {"images", images},          {"suns", sun_rows(simulation, result)},
          {"orders", orders},    {"band_names", names},       {"fluxes", fluxes}};
}

}  // namespace bpms
