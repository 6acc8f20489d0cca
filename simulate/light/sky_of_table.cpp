// A sky of type "map": a table from a file becomes the map of the scene's bands, linear in wavelength.
#include <algorithm>

#include "core/units.h"
#include "simulate/light/curve.h"
#include "simulate/light/light.h"
#include "simulate/light/sky_table.h"

namespace bpms {
namespace {

// Columns by compass. Where the scene counts azimuths from the east, column c of the map is that of 90
// degrees less c.
std::size_t column_in_table(std::size_t column, std::size_t count, bool north_clockwise) {
  return north_clockwise ? column : (count / 4 + count - column) % count;
}

}  // namespace

Sky read_map_sky(const TomlValue& table, const LightContext& context) {
  const TomlValue file = table.get("file"), scale_key = table.get("scale"), total = table.get("irradiance");
  if (!file) table.reject_choice("missing key 'file'");
  if (scale_key && total) scale_key.reject("irradiance says it already");
  context.inputs.push_back(file.file_relative(file.string()));
  const std::string path = context.inputs.back();
  SkyTable sky = read_sky_table(path);
  const std::size_t zeniths = sky.zenith_deg.size(), azimuths = sky.azimuth_deg.size();
  const std::size_t bands = context.bands.count();
  if (!context.domain.azimuth_north_clockwise && azimuths > 1 && azimuths % 4 != 0)
    bad_input({path}, "{} azimuths: expected a multiple of 4 where azimuths count from the east", azimuths);
  if (!sky.wavelength_nm.empty() && context.bands.wavelengths_nm.empty())
    file.reject("a sky with wavelengths needs [bands] wavelengths_nm");
  const double scale = scale_key ? scale_key.positive() : 1.0;
  std::vector<double> among(bands, 0.0);  // position among the table's wavelengths
  if (!sky.wavelength_nm.empty()) {
    ColumnCurve position{path, sky.wavelength_nm, {}};
    for (std::size_t w = 0; w < sky.wavelength_nm.size(); ++w) position.y.push_back(static_cast<double>(w));
    among = at_bands(position, context.bands, file);
  }
  std::vector<float> radiance(zeniths * azimuths * bands);
  for (std::size_t band = 0; band < bands; ++band) {
    const auto below = static_cast<std::size_t>(among[band]);
    const std::size_t above = std::min(below + 1, sky.colours() - 1);
    const double part = among[band] - static_cast<double>(below);
    for (std::size_t z = 0; z < zeniths; ++z)
      for (std::size_t a = 0; a < azimuths; ++a) {
        const std::size_t from =
            azimuths == 1 ? 0 : column_in_table(a, azimuths, context.domain.azimuth_north_clockwise);
        radiance[(z * azimuths + a) * bands + band] =
            static_cast<float>(scale * ((1 - part) * sky.at(z, from, below) + part * sky.at(z, from, above)));
      }
  }
  if (!total) return sky_of(std::make_shared<const SkyMap>(zeniths, azimuths, bands, std::move(radiance)));
  const bool brf = total.is_string() && total.string() == "brf";
  const std::vector<double> wanted =
      brf ? std::vector<double>(bands, pi) : read_source_spectrum(total, context.bands, context.inputs);
  const std::vector<double> has = SkyMap(zeniths, azimuths, bands, radiance).irradiance();
  for (std::size_t band = 0; band < bands; ++band) {
    if (!(has[band] > 0) && wanted[band] > 0)
      total.reject(fmt::format("the sky is black in {}: nothing to scale", context.bands.name(band)));
    const double factor = has[band] > 0 ? wanted[band] / has[band] : 0.0;
    for (std::size_t i = band; i < radiance.size(); i += bands)
      radiance[i] = static_cast<float>(factor * static_cast<double>(radiance[i]));
  }
  return sky_of(std::make_shared<const SkyMap>(zeniths, azimuths, bands, std::move(radiance)));
}

}  // namespace bpms
