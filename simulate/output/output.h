// Writers of a result: NetCDF-CF, tidy CSV, JSON report, PNG quick-looks. Names and columns are those of the
// file formats page; a value without a number (a pixel that an interrupt left out) is NaN, an empty field,
// null.
#pragma once
#include "core/json.h"
#include "core/png.h"
#include "core/provenance.h"
#include "simulate/simulate.h"

namespace bpms {

// One file; with several sensors, one group of names each: SENSOR_brf and so on. One sensor: plain names.
void write_netcdf(const Simulation& simulation, const Result& result, const Provenance& provenance,
                  const std::string& path, bool overwrite);

// All parts of reflectance and radiance; of the bands beyond `split_bands` totals only.
inline constexpr std::size_t split_bands = 8;
std::string result_csv(const Simulation& simulation, const Result& result);

Json result_report(const Simulation& simulation, const Result& result);

// Red, green, blue from the bands nearest to 650, 550 and 450 nm when they lie in the visible, else grey
// (band 1); black to the 99.5th percentile, gamma 2.2.
RgbImage quick_look(const Simulation& simulation, const SensorResult& result);

}  // namespace bpms
