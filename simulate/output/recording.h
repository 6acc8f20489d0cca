// What `bpms simulate --keep-interactions` leaves in its result for other spectra: the interaction histogram
// of each view, the fractions that no spectrum changes, the light, the angles of views.
#pragma once
#include <string>
#include <vector>

#include "simulate/output/netcdf.h"
#include "simulate/simulate.h"

namespace bpms {

// Adds the histograms of a sensor, and once a file what they mean, to a result.
void write_recording(const Simulation& simulation, NetcdfWriter& file);
void write_histograms(const SensorResult& result, NetcdfWriter& file, const std::string& prefix,
                      const std::string& view_dimension);

struct Recording {
  // Sensors as lists of angles, light at the wavelengths that were traced, materials by name with the spectra
  // that were traced; no geometry.
  Simulation simulation;
  std::vector<SensorResult> sensors;  // with histograms and fractions
  std::uint64_t seed = 1;
  std::string stopped_by;
};
Recording read_recording(const std::string& path);

}  // namespace bpms
