#include "simulate/transport/stage.h"

namespace bpms {

Stage make_stage(const Simulation& simulation, const Intersector& intersector) {
  Stage out{&intersector, &simulation, make_optics(simulation), extent_of(intersector), nullptr};
  if (simulation.light.sun)
    out.sun_rays = intersector.parallel_rays(simulation.scene, simulation.light.sun->direction);
  return out;
}

}  // namespace bpms
