// Materials and light as flat tables for the hot loop. A path carries `lanes` bands at once: all of them when
// there are at most that many, else a few guides that steer roulette. A factor is a spectrum that one
// interaction multiplies a path's weight by: a reflectance (front, back) or transmittance of a diffuse
// surface, the spectrum of a separable lobe.
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

// 3 * material + {0 front, 1 back reflectance, 2 transmittance}; then the lobes' spectra.
using Factor = std::uint32_t;
inline constexpr Factor no_factor = 0xffffffffu;
inline Factor reflectance_factor(std::uint32_t material, bool front) {
  return 3 * material + (front ? 0 : 1);
}
inline Factor transmittance_factor(std::uint32_t material) {
  return 3 * material + 2;
}

// What one interaction multiplies a path's weight by: scale * the factor's spectrum * `values`, each where
// there is one. `values`: a place for each traced band, at least `lanes` of them.
struct Scatter {
  Factor factor = no_factor;
  float scale = 1;
  const float* values = nullptr;
};

struct LobeOptics {
  const Lobe* lobe = nullptr;
  Factor factor = no_factor;  // of a separable lobe
  std::array<bool, 2> on_face{};
};

// The ways on from a surface, seen from a face: chances that add up to 1.
struct SurfaceOptics {
  bool opaque = true;
  bool diffuse = true;                 // no lobes: reflects with chance reflect_share, else transmits
  std::array<float, 2> reflect_share;  // by face; of the diffuse part
  std::array<float, 2> diffuse_share{1, 1};
  std::vector<LobeOptics> lobes;
  std::vector<std::array<float, 2>> lobe_share;  // by lobe and face
  bool lets_through = false;  // a shadow ray, weakened: has a straight lobe, or shadows are attenuated
};

// The way that a path goes on: the diffuse part (`lobe` is their number) or a lobe, and the chance it had.
struct ChosenWay {
  std::size_t lobe;
  float chance;
};
// By `side` in [0, 1), which is stretched to choose again within the diffuse part.
inline ChosenWay choose_way(const SurfaceOptics& surface, std::size_t face, double& side) {
  const auto diffuse = static_cast<double>(surface.diffuse_share[face]);
  if (side < diffuse) {
    side /= diffuse;
    return {surface.lobes.size(), surface.diffuse_share[face]};
  }
  double left = side - diffuse;
  std::size_t k = 0;
  while (k + 1 < surface.lobes.size() && left >= static_cast<double>(surface.lobe_share[k][face]))
    left -= static_cast<double>(surface.lobe_share[k++][face]);
  return {k, surface.lobe_share[k][face]};
}

// Of a material whose properties change over (U,V).
struct SurfaceMaps {
  const Raster* map = nullptr;
  std::vector<std::uint32_t> materials;  // by the map's integers
  const Raster* bump = nullptr;
  float bump_m = 0;
};

// How the bands travel with a path.
enum class Carriage {
  carried,   // all of them, one a lane
  counted,   // interactions are counted, spectra come in at the end
  spectrum,  // a weight for each band, in a row of its own
  sampled    // a lane for each written band, at a wavelength that the path draws
};

struct Optics {
  std::vector<Lanes> factors;                // by Factor, of the lanes' bands
  std::vector<std::vector<double>> spectra;  // by Factor, of all traced bands
  std::vector<std::vector<float>> single;    // the same in single precision, for spectrum and sampled
  std::vector<SurfaceOptics> surfaces;       // by material
  std::vector<std::size_t> lane_bands;       // which traced band a lane stands for
  std::size_t bands = 1;                     // traced
  Carriage carriage = Carriage::carried;
  bool lets_through = false;      // some surface does
  std::vector<SurfaceMaps> maps;  // by material; empty where none has any
};
Optics make_optics(const Simulation& simulation);

}  // namespace bpms
