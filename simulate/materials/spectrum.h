// Spectral quantities as scene.toml writes them: a number (flat), a table [[nm, value], ...] or
// "spectrum.csv" with a column of wavelengths (nm) and one of values; linear in between, never extrapolated.
// Given out per band.
#pragma once
#include <string>
#include <vector>

#include "core/toml.h"

namespace bpms {

// Bands are monochromatic at these wavelengths; a scene without [bands] has one band and no wavelength.
struct Bands {
  std::vector<double> wavelengths_nm;  // empty: one band without a wavelength
  std::size_t count() const { return wavelengths_nm.empty() ? 1 : wavelengths_nm.size(); }
  std::string name(std::size_t band) const;  // "band 3 (850 nm)", for messages
};

inline constexpr double shortest_wavelength_nm = 1.0;
inline constexpr double longest_wavelength_nm = 2500.0;
Bands read_bands(const TomlValue& table);

// One value a band, each within [low, high]. Files that were read are added to `inputs`.
std::vector<double> read_spectrum(const TomlValue& value, const Bands& bands, double low, double high,
                                  std::vector<std::string>& inputs);

}  // namespace bpms
