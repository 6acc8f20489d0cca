// What one interaction does to a photon's weights, for all bands: a row of floats for each Factor (see
// transport/optics.h), padded to `width`, so that loops run over whole groups of eight.
#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "simulate/transport/optics.h"

namespace bpms {

class PhotonOptics {
 public:
  explicit PhotonOptics(const Simulation& simulation);

  std::size_t bands, width;
  const float* factor(Factor which) const { return factors_.data() + which * width; }
  // 1 - reflectance - transmittance of a face of a diffuse surface.
  const float* absorbed(std::uint32_t material, bool front) const {
    return absorbed_.data() + (2 * material + (front ? 0 : 1)) * width;
  }
  const SurfaceOptics& surface(std::uint32_t material) const { return optics_.surfaces[material]; }
  // What the surface is made of where it was hit.
  std::uint32_t material_at(const Hit& hit) const {
    if (optics_.maps.empty() || optics_.maps[hit.material].map == nullptr) return hit.material;
    const SurfaceMaps& maps = optics_.maps[hit.material];
    return maps.materials[static_cast<std::size_t>(maps.map->nearest(hit.uv))];
  }
  float largest_factor() const { return *std::max_element(factors_.begin(), factors_.end()); }
  bool opaque(std::uint32_t material) const { return optics_.surfaces[material].opaque; }

 private:
  Optics optics_;
  std::vector<float> factors_, absorbed_;
};

// Over rows of `width` floats (a multiple of 8).
inline void multiply_weights(float* weight, const float* factor, float scale, std::size_t width) {
  for (std::size_t b = 0; b < width; b += 8)
    for (std::size_t i = b; i < b + 8; ++i) weight[i] *= factor[i] * scale;
}
inline void scale_weights(float* weight, float scale, std::size_t width) {
  for (std::size_t b = 0; b < width; b += 8)
    for (std::size_t i = b; i < b + 8; ++i) weight[i] *= scale;
}
inline float largest_weight(const float* weight, std::size_t width) {
  float out = 0;
  for (std::size_t b = 0; b < width; ++b) out = std::max(out, weight[b]);
  return out;
}

}  // namespace bpms
