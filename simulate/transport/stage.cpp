#include "simulate/transport/stage.h"

namespace bpms {

Stage make_stage(const Simulation& simulation, const Intersector& intersector) {
  Stage out{&intersector, &simulation, make_optics(simulation), extent_of(intersector), nullptr};
  if (!simulation.light.suns.empty())
    out.sun_rays = intersector.parallel_rays(simulation.scene, simulation.light.suns.front().direction);
  return out;
}

}  // namespace bpms
