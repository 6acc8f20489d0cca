#include <algorithm>
#include <array>
#include <cmath>

#include "simulate/output/output.h"

namespace bpms {
namespace {

// The band nearest to a colour; band 0 for all of them unless three different ones are near.
std::array<std::size_t, 3> colour_bands(const Bands& bands) {
  constexpr std::array<double, 3> colours_nm{650, 550, 450};
  constexpr double near_nm = 60;
  std::array<std::size_t, 3> out{};
  for (std::size_t c = 0; c < 3; ++c) {
    double best = near_nm;
    bool found = false;
    for (std::size_t b = 0; b < bands.written(); ++b) {
      const double off = std::abs(bands.written_nm(b) - colours_nm[c]);
      if (off <= best) {
        best = off;
        out[c] = b;
        found = true;
      }
    }
    if (!found) return {};
  }
  return out;
}

}  // namespace

RgbImage quick_look(const Simulation& simulation, const SensorResult& result) {
  const std::size_t bands = simulation.bands.written();
  const std::vector<double>& radiance = result.radiance.front().value;
  const std::size_t pixels = result.samples.size();
  const auto chosen = colour_bands(simulation.bands);
  std::vector<double> shown;
  for (std::size_t i = 0; i < pixels; ++i)
    for (const std::size_t band : chosen)
      if (result.samples[i] > 0) shown.push_back(radiance[i * bands + band]);
  double white = 1;
  if (!shown.empty()) {
    constexpr double percentile = 0.995;
    const auto at = static_cast<std::ptrdiff_t>(percentile * static_cast<double>(shown.size() - 1));
    std::nth_element(shown.begin(), shown.begin() + at, shown.end());
    if (shown[static_cast<std::size_t>(at)] > 0) white = shown[static_cast<std::size_t>(at)];
  }
  RgbImage out{result.sensor->width(), result.sensor->height(), std::vector<std::uint8_t>(pixels * 3, 0)};
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (result.samples[i] == 0) continue;
      const double value = std::clamp(radiance[i * bands + chosen[c]] / white, 0.0, 1.0);
      out.rgb[3 * i + c] = static_cast<std::uint8_t>(std::lround(255.0 * std::pow(value, 1 / 2.2)));
    }
  }
  return out;
}

}  // namespace bpms
