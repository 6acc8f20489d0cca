// The keys of a sky of type "zibordi_voss", and the map that comes of them.
#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "simulate/light/curve.h"
#include "simulate/light/light.h"
#include "simulate/light/zibordi_voss.h"

namespace bpms {
namespace {

namespace zv = zibordi_voss;

// Spectra that the model is made of, per band.
struct ZibordiVossInputs {
  std::vector<double> sun, ozone, water, gas, albedo;
};

// A key of its own, or the file of this name in the folder `tables`.
std::vector<double> coefficients(const TomlValue& table, const char* key, const char* file,
                                 const LightContext& context) {
  const TomlValue own = table.get(key), tables = table.get("tables");
  if (own && !own.is_string() && !own.is_table())
    return read_spectrum(own, context.bands, 0.0, brightest, context.inputs);
  if (own) return at_bands(read_curve(own, context.inputs), context.bands, own);
  if (!tables)
    table.reject_choice(
        fmt::format("missing key '{}', or tables = \"FOLDER\" that holds a file {}", key, file));
  context.inputs.push_back(tables.file_relative(tables.string() + "/" + file));
  return at_bands(read_curve(context.inputs.back(), "2"), context.bands, tables);
}

void read_aerosol(const TomlValue& table, zv::Atmosphere& out, double& scale_height_km) {
  if (!table) return;
  out.alpha = table.number_or("alpha", out.alpha);
  if (const TomlValue key = table.get("beta")) out.beta = key.number(0, 10);
  if (const TomlValue key = table.get("single_scattering_albedo")) out.aerosol_albedo = key.number(0, 1);
  if (const TomlValue key = table.get("scale_height_km")) scale_height_km = key.positive();
  if (const TomlValue key = table.get("henyey_greenstein")) {
    const std::vector<double> numbers = key.numbers(3);
    out.phase = {numbers[0], numbers[1], numbers[2]};
    if (!(numbers[0] >= 0 && numbers[0] <= 1 && std::abs(numbers[1]) < 1 && std::abs(numbers[2]) < 1))
      key.reject("expected [weight of the first, g1, g2]: weight from 0 to 1, g1 and g2 between -1 and 1");
  }
}

// The part of a column above a height, by its density over height (km).
double above_by_profile(const TomlValue& value, double height_km, std::vector<std::string>& inputs) {
  const ColumnCurve density = read_curve(value, inputs);
  if (!density.holds(height_km))
    value.reject(fmt::format("{} runs from {} to {} km: altitude_km is {}", density.path, density.x.front(),
                             density.x.back(), height_km));
  double all = 0, above = 0;
  for (std::size_t i = 0; i < density.x.size(); ++i) {
    if (!(density.y[i] >= 0)) bad_input({density.path}, "a density of {}: expected 0 or more", density.y[i]);
    if (i == 0) continue;
    const auto layer = [&](double from) {
      return 0.5 * (density.at(from) + density.y[i]) * (density.x[i] - from);
    };
    all += layer(density.x[i - 1]);
    if (density.x[i] > height_km) above += layer(std::max(height_km, density.x[i - 1]));
  }
  if (!(all > 0)) bad_input({density.path}, "the density is 0 at every height");
  return above / all;
}

void read_altitude(const TomlValue& table, double scale_height_km, const LightContext& context,
                   zv::Atmosphere& out) {
  const TomlValue altitude = table.get("altitude_km"), profiles = table.get("profiles");
  const TomlValue peak = table.get("ozone_peak_km"), width = table.get("ozone_width_km");
  const double peak_km = peak ? peak.positive() : 20, width_km = width ? width.positive() : 5;
  const double dew_point_c = table.number_or("dew_point_c", 10.02);
  const double height_km = altitude ? altitude.number(0, 100) : 0;
  if (height_km > 0) {
    out.rayleigh_above = zv::rayleigh_above(height_km);
    out.aerosol_above = zv::aerosol_above(height_km, scale_height_km);
    out.ozone_above = zv::ozone_above(height_km, peak_km, width_km);
    if (out.water_cm > 0) out.water_above = zv::water_above(height_km, out.water_cm, dew_point_c);
  }
  if (!profiles) return;
  if (!altitude) profiles.reject("profiles act with altitude_km only");
  const auto profile = [&](const char* key, double& above) {
    if (const TomlValue value = profiles.get(key)) above = above_by_profile(value, height_km, context.inputs);
  };
  profile("air", out.rayleigh_above);
  profile("aerosol", out.aerosol_above);
  profile("ozone", out.ozone_above);
  profile("water", out.water_above);
}

zv::Atmosphere read_atmosphere(const TomlValue& table, const LightContext& context) {
  zv::Atmosphere out;
  double scale_height_km = 0.97;
  if (const TomlValue key = table.get("rayleigh")) {
    const std::vector<double> numbers = key.numbers(4);
    std::copy(numbers.begin(), numbers.end(), out.rayleigh.begin());
    if (!(numbers[0] >= 0)) key.reject("expected [A, B, C, D] of A um^-(B + C um + D / um), A not below 0");
  }
  if (const TomlValue key = table.get("ozone_cm")) out.ozone_cm = key.number(0, 10);
  if (const TomlValue key = table.get("water_cm")) out.water_cm = key.number(0, 100);
  read_aerosol(table.get("aerosol"), out, scale_height_km);
  read_altitude(table, scale_height_km, context, out);
  return out;
}

Sun& sun_of(const TomlValue& table, const LightContext& context) {
  const TomlValue name = table.get("sun");
  if (context.suns.empty()) table.reject("a sky of type \"zibordi_voss\" needs a sun");
  if (!name) return context.suns.front();
  for (Sun& sun : context.suns)
    if (sun.name == name.string()) return sun;
  name.reject(fmt::format("no sun named {}", in_quotes(name.string())));
}

std::size_t grid_size(const TomlValue& table, const char* key, long long least, std::size_t otherwise) {
  const TomlValue value = table.get(key);
  constexpr long long most = 3600;
  return value ? static_cast<std::size_t>(value.integer(least, most)) : otherwise;
}

}  // namespace

Sky read_zibordi_voss_sky(const TomlValue& table, const LightContext& context) {
  const std::size_t bands = context.bands.count();
  for (const char* key : {"tables", "extraterrestrial", "ozone_absorption", "water_absorption",
                          "gas_absorption", "surface_albedo", "day_of_year"})
    table.get(key);
  if (context.bands.wavelengths_nm.empty()) table.reject("the model needs [bands] wavelengths_nm");
  const zv::Atmosphere atmosphere = read_atmosphere(table, context);
  Sun& sun = sun_of(table, context);
  const std::size_t zeniths = grid_size(table, "zeniths", 2, 91),
                    azimuths = grid_size(table, "azimuths", 1, 120);
  const TomlValue albedo = table.get("surface_albedo"), day = table.get("day_of_year");
  if (!albedo)
    table.reject_choice("missing key 'surface_albedo', of the land around: a number or a spectrum");
  ZibordiVossInputs in;
  in.sun = coefficients(table, "extraterrestrial", "E0D", context);
  in.ozone = coefficients(table, "ozone_absorption", "KO3", context);
  in.water = coefficients(table, "water_absorption", "KW", context);
  in.gas = coefficients(table, "gas_absorption", "KG", context);
  in.albedo = read_spectrum(albedo, context.bands, 0.0, 1.0, context.inputs);
  const double distance = day ? zv::sun_distance_factor(day.number(1, 367)) : 1.0;

  std::vector<float> radiance(zeniths * azimuths * bands);
  std::vector<double> direct(bands);
  std::size_t negative = 0;
  for (std::size_t band = 0; band < bands; ++band) {
    const zv::Depths depths = zv::depths(atmosphere, context.bands.wavelengths_nm[band], in.ozone[band],
                                         in.water[band], in.gas[band]);
    const double e0 = in.sun[band] * distance;
    direct[band] = e0 * std::exp(-depths.total() * zv::air_mass(sun.zenith_deg));
    const zv::ClearSky sky(atmosphere, depths, radians(sun.zenith_deg), in.albedo[band]);
    for (std::size_t row = 0; row < zeniths; ++row)
      for (std::size_t column = 0; column < azimuths; ++column) {
        const double zenith = 0.5 * pi * static_cast<double>(row) / static_cast<double>(zeniths - 1);
        const double azimuth = 2 * pi * static_cast<double>(column) / static_cast<double>(azimuths);
        const double mu = row + 1 == zeniths ? 0.0 : std::cos(zenith);
        const Eigen::Vector3d towards(std::sin(zenith) * std::sin(azimuth),
                                      std::sin(zenith) * std::cos(azimuth), mu);
        const double value = e0 * sky.radiance(mu, std::min(1.0, towards.dot(sun.direction)));
        negative += value < 0 ? 1 : 0;
        radiance[(row * azimuths + column) * bands + band] = static_cast<float>(std::max(0.0, value));
      }
  }
  if (negative > 0)
    context.notes.push_back(
        fmt::format("zibordi_voss: the model is below 0 at {:.2g} % of the sky, taken as black",
                    100.0 * static_cast<double>(negative) / static_cast<double>(radiance.size())));
  if (sun.model == "zibordi_voss") sun.irradiance = std::move(direct);
  return sky_of(std::make_shared<const SkyMap>(zeniths, azimuths, bands, std::move(radiance)));
}

}  // namespace bpms
