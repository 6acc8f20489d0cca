// Reverse path tracing: from the sensor, a ray to the sun at each interaction, one diffuse ray onward, the
// sky gathered by the ray that escapes. Geometric normals throughout, so that no light leaks or is made.
#pragma once
#include "scene/intersect/parallel_rays.h"
#include "simulate/transport/optics.h"
#include "simulate/transport/sampler.h"

namespace bpms {

struct Stage {
  const Intersector* intersector = nullptr;
  const Simulation* simulation = nullptr;
  Optics optics;
  Extent extent;
  std::unique_ptr<const ParallelRays> sun_rays;  // null: shadow rays go through the intersector
};
Stage make_stage(const Simulation& simulation, const Intersector& intersector);

// Adds paths [first, last) of a view's batch to the tally; stops early at an interrupt. `view_rays`, or null,
// finds the first hits of a view whose rays are parallel.
template <class Tally>
void trace_paths(const Stage& stage, const Sensor& sensor, std::size_t view, const ParallelRays* view_rays,
                 PathNumbers numbers, std::uint64_t first, std::uint64_t last, Tally& tally);

}  // namespace bpms
