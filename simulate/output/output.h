// Writers of a result: NetCDF-CF, tidy CSV, JSON report, PNG quick-looks. Names and columns are those of the
// file formats page; a value without a number (a pixel that an interrupt left out) is NaN, an empty field,
// null.
#pragma once
#include "core/json.h"
#include "core/png.h"
#include "core/provenance.h"
#include "simulate/simulate.h"

namespace bpms {

struct NetcdfOptions {
  bool overwrite = false;
  bool image_origins = false;  // pixels by origin of the light too, three times as large
};
// One file; with several sensors, one group of names each: SENSOR_brf and so on. One sensor: plain names.
// Pixels are kept in single precision, their standard errors to three digits.
void write_netcdf(const Simulation& simulation, const Result& result, const Provenance& provenance,
                  const std::string& path, const NetcdfOptions& options);

// The name of a sensor in the names of variables and files: letters, digits and _, unlike those before it.
std::string sensor_identifier(const Simulation& simulation, std::size_t sensor);

// All parts of reflectance and radiance; of the bands beyond `split_bands` totals only. Values to seven
// digits, which is what single-precision light has, standard errors to three.
inline constexpr std::size_t split_bands = 8;
std::string result_csv(const Simulation& simulation, const Result& result);

// d(radiance)/d(value of a factor's spectrum), of all light together.
struct Derivatives {
  std::vector<std::string> factors;
  std::vector<Estimates> by_sensor;  // views x bands x factors
};

// Derivatives of the reflectance by the value of each spectrum, in each view and band.
std::string derivatives_csv(const Simulation& simulation, const Result& result,
                            const Derivatives& derivatives);

Json result_report(const Simulation& simulation, const Result& result);

// Red, green, blue from the bands nearest to 650, 550 and 450 nm when they lie in the visible, else grey
// (band 1); black to the 99.5th percentile, gamma 2.2.
RgbImage quick_look(const Simulation& simulation, const SensorResult& result);

}  // namespace bpms
