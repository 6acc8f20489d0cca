#include "simulate/light/sky_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/csv.h"
#include "simulate/light/light.h"

namespace bpms {
namespace {

void require_regular(const std::string& path, const char* name, const std::vector<double>& values, double end,
                     bool closed) {
  const auto count = static_cast<double>(values.size());
  const double step = end / (closed ? std::max(1.0, count - 1) : count);
  constexpr double tolerance = 1e-6;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(std::abs(values[i] - step * static_cast<double>(i)) <= tolerance * end))
      bad_input({path}, "{} has {} values and {} among them: expected 0, {:.6g}, {:.6g} ... {}", name,
                values.size(), values[i], step, 2 * step, closed ? end : end - step);
}

// The distinct values of one column, and where each stands among them.
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

// One azimuth at the zenith stands for all; anything else that is missing is named.
void require_full(SkyTable& sky, const std::string& path) {
  for (std::size_t w = 0; w < sky.colours(); ++w) {
    std::size_t given = 0, any = 0;
    for (std::size_t a = 0; a < sky.azimuth_deg.size(); ++a)
      if (!std::isnan(sky.at(0, a, w))) ++given, any = a;
    if (given == 1)
      for (std::size_t a = 0; a < sky.azimuth_deg.size(); ++a) sky.at(0, a, w) = sky.at(0, any, w);
  }
  for (std::size_t z = 0; z < sky.zenith_deg.size(); ++z)
    for (std::size_t a = 0; a < sky.azimuth_deg.size(); ++a)
      for (std::size_t w = 0; w < sky.colours(); ++w)
        if (std::isnan(sky.at(z, a, w)))
          bad_input({path}, "no radiance at zenith_deg {}, azimuth_deg {}{}: expected a full grid",
                    sky.zenith_deg[z], sky.azimuth_deg[a],
                    sky.wavelength_nm.empty() ? std::string()
                                              : fmt::format(", wavelength_nm {}", sky.wavelength_nm[w]));
}

}  // namespace

void require_sky_grid(const SkyTable& sky, const std::string& path) {
  if (sky.zenith_deg.size() < 2) bad_input({path}, "one zenith_deg: expected 0 ... 90");
  require_regular(path, "zenith_deg", sky.zenith_deg, 90, true);
  require_regular(path, "azimuth_deg", sky.azimuth_deg, 360, false);
  constexpr double longest_um = 100;
  if (!sky.wavelength_nm.empty() && sky.wavelength_nm.back() <= longest_um)
    bad_input({path}, "wavelengths up to {} look like micrometres (um): expected nm",
              sky.wavelength_nm.back());
  constexpr double most = 5e8;
  const double size = static_cast<double>(sky.zenith_deg.size()) *
                      static_cast<double>(sky.azimuth_deg.size()) * static_cast<double>(sky.colours());
  if (size > most) bad_input({path}, "a grid of {:.3g} values: expected at most {:.3g}", size, most);
}

double require_radiance(double value, const SourceLocation& where) {
  if (!(value >= 0 && value <= brightest))
    bad_input(where, "radiance {}: expected a value from 0 to {}", value, brightest);
  return value;
}

SkyTable read_sky_csv(const std::string& path) {
  const CsvTable csv = CsvTable::read(path);
  const int zenith = csv.require("zenith_deg"), azimuth = csv.require("azimuth_deg");
  const int radiance = csv.require("radiance"), wavelength = csv.find("wavelength_nm");
  if (csv.rows() == 0) bad_input({path}, "no rows");
  const GridAxis zeniths = axis_of(csv, zenith), azimuths = axis_of(csv, azimuth);
  const GridAxis wavelengths = wavelength < 0 ? GridAxis{} : axis_of(csv, wavelength);
  SkyTable out{zeniths.values, azimuths.values, wavelengths.values, {}};
  require_sky_grid(out, path);
  out.radiance.assign(zeniths.values.size() * azimuths.values.size() * out.colours(), std::nan(""));
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    double& cell =
        out.at(zeniths.index.at(csv.number(row, zenith)), azimuths.index.at(csv.number(row, azimuth)),
               wavelength < 0 ? 0 : wavelengths.index.at(csv.number(row, wavelength)));
    if (!std::isnan(cell)) bad_input(csv.where(row, radiance), "a second value for this direction");
    cell = require_radiance(csv.number(row, radiance), csv.where(row, radiance));
  }
  return out;
}

SkyTable read_sky_table(const std::string& path) {
  SkyTable out = path.ends_with(".nc") ? read_sky_netcdf(path) : read_sky_csv(path);
  require_full(out, path);
  return out;
}

}  // namespace bpms
