// The vertices of many photon paths, kept so that view after view can ask which of them it sees: where light
// has arrived at a surface, how much of it, and after how many interactions. Sorted along a Morton curve.
#pragma once
#include <vector>

#include "simulate/forward/photon_wave.h"

namespace bpms {

struct PathVertex {
  Eigen::Vector3f position, normal;
  std::uint32_t instance, primitive;
  std::uint32_t sample;
  std::uint16_t material;
  std::uint8_t order;  // of the light that leaves from here: 1 and more, the last for all beyond
  std::uint8_t batch : 5, front : 1, ground : 1;
  std::uint8_t geometry;
  std::uint8_t source;  // index into PhotonStage::sources

  SurfaceId surface() const { return {instance, geometry, primitive}; }
};

struct PathVertices {
  std::vector<PathVertex> list;
  std::vector<float> weights;  // list x bands
  std::uint64_t rays = 0;
  // Bytes of one, with its weights.
  static std::size_t bytes(std::size_t bands) { return sizeof(PathVertex) + 4 * bands; }
};

// Those of the samples [first, last) of every batch of every source; of the sun's light, the first orders are
// left to the views' own rays. `sun_rays`: by source, or null. Orders above `orders` count as that.
PathVertices trace_vertices(const PhotonStage& stage, const std::vector<const ParallelRays*>& sun_rays,
                            std::uint64_t seed, std::uint32_t stream, int orders, std::uint64_t first,
                            std::uint64_t last);

}  // namespace bpms
