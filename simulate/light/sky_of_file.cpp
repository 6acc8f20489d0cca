// A measured or modelled sky from a table: zenith_deg, azimuth_deg, wavelength_nm, radiance, one row each, in
// any order, on a regular grid: zeniths 0 ... 90 in equal steps; azimuths from 0 in equal steps around, in
// the scene's convention; all wavelengths everywhere. At the zenith one azimuth may stand for all. Without
// wavelength_nm the sky has no colour. Bands are interpolated linearly in wavelength.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/csv.h"
#include "core/units.h"
#include "simulate/light/curve.h"
#include "simulate/light/light.h"

namespace bpms {
namespace {

// The sorted values of one column.
struct GridAxis {
  std::vector<double> values;
  std::map<double, std::size_t> index;
};
GridAxis axis_of(const CsvTable& csv, int column) {
  std::set<double> values;
  for (std::size_t row = 0; row < csv.rows(); ++row) values.insert(csv.number(row, column));
  GridAxis out;
  for (const double value : values) {
    out.index[value] = out.values.size();
    out.values.push_back(value);
  }
  return out;
}

void require_regular(const CsvTable& csv, const char* column, const GridAxis& axis, double end, bool closed) {
  const auto count = static_cast<double>(axis.values.size());
  const double step = end / (closed ? std::max(1.0, count - 1) : count);
  constexpr double tolerance = 1e-6;
  for (std::size_t i = 0; i < axis.values.size(); ++i)
    if (std::abs(axis.values[i] - step * static_cast<double>(i)) > tolerance * end)
      bad_input({csv.path()}, "{} has {} values and {} among them: expected 0, {:.6g}, {:.6g} ... {}", column,
                axis.values.size(), axis.values[i], step, 2 * step, closed ? end : end - step);
}

struct SkyTable {
  GridAxis zenith, azimuth, wavelength;  // no wavelength: empty
  std::vector<double> radiance;          // (zenith, azimuth, wavelength); NaN: missing
  std::size_t colours() const { return std::max<std::size_t>(1, wavelength.values.size()); }
  double& at(std::size_t z, std::size_t a, std::size_t w) {
    return radiance[(z * azimuth.values.size() + a) * colours() + w];
  }
};

SkyTable read_sky_table(const std::string& path) {
  const CsvTable csv = CsvTable::read(path);
  const int zenith = csv.require("zenith_deg"), azimuth = csv.require("azimuth_deg");
  const int radiance = csv.require("radiance"), wavelength = csv.find("wavelength_nm");
  if (csv.rows() == 0) bad_input({path}, "no rows");
  SkyTable out;
  out.zenith = axis_of(csv, zenith);
  out.azimuth = axis_of(csv, azimuth);
  if (wavelength >= 0) out.wavelength = axis_of(csv, wavelength);
  if (out.zenith.values.size() < 2) bad_input({path}, "one zenith_deg: expected 0 ... 90");
  require_regular(csv, "zenith_deg", out.zenith, 90, true);
  require_regular(csv, "azimuth_deg", out.azimuth, 360, false);
  if (wavelength >= 0 && out.wavelength.values.back() <= 100)
    bad_input({path}, "wavelengths up to {} look like micrometres (um): expected nm",
              out.wavelength.values.back());
  constexpr std::size_t most = 500'000'000;
  const std::size_t size = out.zenith.values.size() * out.azimuth.values.size() * out.colours();
  if (size > most) bad_input({path}, "a grid of {} values: expected at most {}", size, most);
  out.radiance.assign(size, std::nan(""));
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const double value = csv.number(row, radiance);
    if (!(value >= 0 && value <= brightest))
      bad_input(csv.where(row, radiance), "radiance {}: expected a value from 0 to {}", value, brightest);
    double& cell =
        out.at(out.zenith.index.at(csv.number(row, zenith)), out.azimuth.index.at(csv.number(row, azimuth)),
               wavelength < 0 ? 0 : out.wavelength.index.at(csv.number(row, wavelength)));
    if (!std::isnan(cell)) bad_input(csv.where(row, radiance), "a second value for this direction");
    cell = value;
  }
  return out;
}

// One azimuth at the zenith stands for all; anything else that is missing is named.
void require_full(SkyTable& sky, const std::string& path) {
  for (std::size_t w = 0; w < sky.colours(); ++w) {
    std::size_t given = 0, any = 0;
    for (std::size_t a = 0; a < sky.azimuth.values.size(); ++a)
      if (!std::isnan(sky.at(0, a, w))) ++given, any = a;
    if (given == 1)
      for (std::size_t a = 0; a < sky.azimuth.values.size(); ++a) sky.at(0, a, w) = sky.at(0, any, w);
  }
  for (std::size_t z = 0; z < sky.zenith.values.size(); ++z)
    for (std::size_t a = 0; a < sky.azimuth.values.size(); ++a)
      for (std::size_t w = 0; w < sky.colours(); ++w)
        if (std::isnan(sky.at(z, a, w)))
          bad_input({path}, "no radiance at zenith_deg {}, azimuth_deg {}{}: expected a full grid",
                    sky.zenith.values[z], sky.azimuth.values[a],
                    sky.wavelength.values.empty()
                        ? std::string()
                        : fmt::format(", wavelength_nm {}", sky.wavelength.values[w]));
}

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
  require_full(sky, path);
  const std::size_t zeniths = sky.zenith.values.size(), azimuths = sky.azimuth.values.size();
  const std::size_t bands = context.bands.count();
  if (!context.domain.azimuth_north_clockwise && azimuths > 1 && azimuths % 4 != 0)
    bad_input({path}, "{} azimuths: expected a multiple of 4 where azimuths count from the east", azimuths);
  if (!sky.wavelength.values.empty() && context.bands.wavelengths_nm.empty())
    file.reject("a sky with wavelengths needs [bands] wavelengths_nm");
  const double scale = scale_key ? scale_key.positive() : 1.0;
  std::vector<double> among(bands, 0.0);  // position among the table's wavelengths
  if (!sky.wavelength.values.empty()) {
    Curve position{path, sky.wavelength.values, {}};
    for (std::size_t w = 0; w < sky.wavelength.values.size(); ++w)
      position.y.push_back(static_cast<double>(w));
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
