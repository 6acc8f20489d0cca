// What all paths share: the scene's rays, the optics, the light.
#pragma once
#include "scene/intersect/parallel_rays.h"
#include "simulate/transport/optics.h"

namespace bpms {

struct Stage {
  const Intersector* intersector = nullptr;
  const Simulation* simulation = nullptr;
  Optics optics;
  Extent extent;
  std::unique_ptr<const ParallelRays> sun_rays;  // null: shadow rays go through the intersector
};
Stage make_stage(const Simulation& simulation, const Intersector& intersector);

}  // namespace bpms
