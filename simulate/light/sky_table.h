// A measured or modelled sky as a table of radiances on a regular grid of zenith, azimuth and wavelength,
// from a file:
//   CSV      zenith_deg, azimuth_deg, wavelength_nm, radiance; one value a row, in any order
//   NetCDF   a variable radiance over the dimensions zenith, azimuth and wavelength, each with a variable of
//            its name, in degrees and nm
// Zeniths 0 ... 90 in equal steps; azimuths from 0 in equal steps all around, in the scene's convention;
// every wavelength everywhere. At the zenith one azimuth may stand for all. Without wavelength the sky has no
// colour.
#pragma once
#include <string>
#include <vector>

#include "core/error.h"

namespace bpms {

struct SkyTable {
  std::vector<double> zenith_deg, azimuth_deg;
  std::vector<double> wavelength_nm;  // empty: one value for all
  std::vector<double> radiance;       // by zenith, azimuth, wavelength; NaN: missing
  std::size_t colours() const { return wavelength_nm.empty() ? 1 : wavelength_nm.size(); }
  double& at(std::size_t zenith, std::size_t azimuth, std::size_t colour) {
    return radiance[(zenith * azimuth_deg.size() + azimuth) * colours() + colour];
  }
};

// By the file's name, FILE.nc or any other; checked as above.
SkyTable read_sky_table(const std::string& path);

SkyTable read_sky_csv(const std::string& path);
SkyTable read_sky_netcdf(const std::string& path);
// What every reader checks once it knows the axes, before the values.
void require_sky_grid(const SkyTable& sky, const std::string& path);
double require_radiance(double value, const SourceLocation& where);

}  // namespace bpms
