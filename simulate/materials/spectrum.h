// Spectral quantities as scene.toml writes them: a number (flat), a table [[nm, value], ...] or
// "spectrum.csv" with a column of wavelengths (nm) and one of values; linear in between, never extrapolated.
// Given out per traced band.
#pragma once
#include <string>
#include <vector>

#include "simulate/materials/bands.h"

namespace bpms {

// One value a band, each within [low, high]. Files that were read are added to `inputs`.
std::vector<double> read_spectrum(const TomlValue& value, const Bands& bands, double low, double high,
                                  std::vector<std::string>& inputs);

}  // namespace bpms
