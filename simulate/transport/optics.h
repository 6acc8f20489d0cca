// Materials and light as flat tables for the hot loop. A path carries `lanes` bands at once: all of them when
// there are at most that many, else a few guides that steer roulette, while the interactions are counted
// (interactions.h). A factor is what one interaction multiplies a path's weight by: reflectance (front, back)
// or transmittance of a material, per band.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "simulate/simulate.h"

namespace bpms {

inline constexpr std::size_t lanes = 8;
struct alignas(32) Lanes {
  std::array<float, lanes> value{};
  void scale(float factor) {
    for (float& v : value) v *= factor;
  }
  void multiply(const Lanes& other) {
    for (std::size_t i = 0; i < lanes; ++i) value[i] *= other.value[i];
  }
  float largest() const {
    float out = 0;
    for (const float v : value) out = v > out ? v : out;
    return out;
  }
};

using Factor = std::uint32_t;  // 3 * material + {0 front, 1 back reflectance, 2 transmittance}
inline Factor reflectance_factor(std::uint32_t material, bool front) {
  return 3 * material + (front ? 0 : 1);
}
inline Factor transmittance_factor(std::uint32_t material) {
  return 3 * material + 2;
}

struct Optics {
  std::vector<Lanes> factors;  // by Factor, of the lanes' bands
  std::vector<std::array<float, 2>>
      reflect_share;                         // by material and face: chance that a path goes on by reflection
  std::vector<char> opaque;                  // by material
  std::vector<std::vector<double>> spectra;  // by Factor, of all bands
  std::size_t bands = 1;
  bool counts_interactions() const { return bands > lanes; }
};
Optics make_optics(const Simulation& simulation);

}  // namespace bpms
