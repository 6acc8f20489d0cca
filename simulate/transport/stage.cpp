#include "simulate/transport/stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bpms {
namespace {

SunOptics make_sun(const Sun& sun, const Simulation& simulation, const Intersector& intersector,
                   bool lets_through) {
  SunOptics out;
  out.direction = sun.direction.cast<float>();
  if (sun.radius > 0) {
    const double c = std::cos(sun.radius), s = std::sin(sun.radius);
    out.radius = static_cast<float>(sun.radius);
    out.cos_radius = static_cast<float>(c);
    out.weight = static_cast<float>(2 / (1 + c));
    out.radiance = static_cast<float>(1 / (std::numbers::pi * s * s));
  } else if (!lets_through) {
    // A grid of the sun's rays is for speed alone: it takes no more than the limit leaves.
    constexpr std::uint64_t most_grid = 1u << 29;
    const std::uint64_t scene = intersector.estimated_bytes(), limit = simulation.most_bytes;
    const std::uint64_t left = limit == 0 ? most_grid : limit > scene ? limit - scene : 0;
    out.rays = intersector.parallel_rays(simulation.scene, sun.direction, std::min(most_grid, left));
  }
  return out;
}

}  // namespace

Stage make_stage(const Simulation& simulation, const Intersector& intersector) {
  Stage out{&intersector, &simulation, make_optics(simulation), extent_of(intersector), {}, {}};
  for (const Sun& sun : simulation.light.suns)
    out.suns.push_back(make_sun(sun, simulation, intersector, out.optics.lets_through));
  if (simulation.light.sky && simulation.light.sky->map)
    for (const double radiance : simulation.light.sky->radiance)
      out.inverse_sky.push_back(radiance > 0 ? static_cast<float>(1 / radiance) : 0.0f);
  return out;
}

}  // namespace bpms
