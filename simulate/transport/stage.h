// What all paths share: the scene's rays, the optics, the light.
#pragma once
#include "scene/intersect/parallel_rays.h"
#include "simulate/transport/optics.h"

namespace bpms {

struct SunOptics {
  Eigen::Vector3f direction;
  float radius = 0, cos_radius = 1;  // of its disc
  // Of light from a direction drawn evenly over the disc, per unit of irradiance on the normal plane.
  float weight = 1;
  float radiance = 0;                        // of the disc, per unit of that irradiance
  std::shared_ptr<const ParallelRays> rays;  // null: shadow rays go through the intersector
};

struct Stage {
  const Intersector* intersector = nullptr;
  const Simulation* simulation = nullptr;
  Optics optics;
  Extent extent;
  std::vector<SunOptics> suns;
  std::vector<float> inverse_sky;  // 1 / the sky's mean radiance, by traced band; for a map
};
Stage make_stage(const Simulation& simulation, const Intersector& intersector);

}  // namespace bpms
