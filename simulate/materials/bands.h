// The wavelengths that are traced and the bands that are written: the same, or bands as weighted means of
// traced wavelengths (response functions of a sensor). A band's radiance is sum(w L) / sum(w), and so is its
// irradiance, so that reflectance factors weigh by response times irradiance.
#pragma once
#include <string>
#include <vector>

#include "core/toml.h"

namespace bpms {

// A band of a sensor: weights of traced wavelengths, which sum to 1.
struct ResponseBand {
  std::string name;
  double centre_nm = 0;  // mean wavelength, weighed by response
  std::vector<std::pair<std::size_t, double>> weights;
};

struct Bands {
  std::vector<double> wavelengths_nm;   // traced; empty: one band without a wavelength
  std::vector<ResponseBand> responses;  // written; empty: what is traced
  bool sampled = false;                 // each path draws its wavelengths from the responses

  std::size_t count() const { return wavelengths_nm.empty() ? 1 : wavelengths_nm.size(); }  // traced
  std::size_t written() const { return responses.empty() ? count() : responses.size(); }
  std::string name(std::size_t traced) const;        // "band 3 (850 nm)", for messages
  double written_nm(std::size_t band) const;         // NaN without a wavelength
  std::string written_name(std::size_t band) const;  // "B8A", or empty
  // From values of the traced wavelengths to those of the written bands.
  std::vector<double> integrate(const std::vector<double>& traced) const;
};

inline constexpr double shortest_wavelength_nm = 1.0;
inline constexpr double longest_wavelength_nm = 2500.0;
// Files that were read are added to `inputs`. An absent table: one band without a wavelength.
Bands read_bands(const TomlValue& table, std::vector<std::string>& inputs);

}  // namespace bpms
