#include "simulate/transport/path.h"

#include <cmath>
#include <numbers>

#include "core/interrupt.h"
#include "simulate/transport/interactions.h"
#include "simulate/transport/lane_tally.h"

namespace bpms {
namespace {

constexpr float inverse_pi = std::numbers::inv_pi_v<float>;

// Of the first hits found in a grid; sqrt(variance x cost) of order 1 over that of the rest, on a canopy of
// LAI 3.
constexpr float followed = 0.6f;

// A direction about `normal` with density cos/pi. Basis: Duff et al. 2017, JCGT 6(1).
Eigen::Vector3f cosine_direction(const Eigen::Vector3f& normal, double u, double v) {
  const auto radius = static_cast<float>(std::sqrt(u));
  const auto angle = static_cast<float>(2.0 * std::numbers::pi * v);
  const float x = radius * std::cos(angle);
  const float y = radius * std::sin(angle);
  const auto z = static_cast<float>(std::sqrt(1.0 - u));
  const float sign = std::copysign(1.0f, normal.z());
  const float a = -1.0f / (sign + normal.z());
  const float b = normal.x() * normal.y() * a;
  const Eigen::Vector3f tangent(1.0f + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x());
  const Eigen::Vector3f bitangent(b, sign + normal.y() * normal.y() * a, -normal.y());
  return (x * tangent + y * bitangent + z * normal).normalized();
}

template <class Tally>
void trace_path(const Stage& stage, Ray ray, const ParallelRays* view_rays, const PathNumbers& numbers,
                Tally& tally) {
  const Intersector& scene = *stage.intersector;
  const Optics& optics = stage.optics;
  const Light& light = stage.simulation->light;
  const Sampling& sampling = stage.simulation->sampling;
  const bool sun = light.sun.has_value();
  const Eigen::Vector3f to_sun = sun ? light.sun->direction.cast<float>().eval() : Eigen::Vector3f::UnitZ();
  typename Tally::Weight weight = tally.unit();

  for (int order = 0;; ++order) {
    Hit hit;
    const Escape end = order > 0 || view_rays == nullptr   ? scene.intersect(ray, hit)
                       : view_rays->first(ray.origin, hit) ? Escape::hit
                                                           : Escape::bottom;
    ++tally.counts.rays;
    if (end != Escape::hit) {
      if (end == Escape::wrap_limit) ++tally.counts.lost;
      if (order == 0) ++tally.counts.gap;
      if (end == Escape::top && light.sky) tally.add_sky(order, weight);
      return;
    }
    if (order == 0 && hit.ground) ++tally.counts.gap;
    const bool opaque = optics.opaque[hit.material] != 0;

    bool lit = false;
    if (sun) {
      const float cosine = hit.geometric_normal.dot(to_sun);
      const bool same_side = (cosine > 0) == hit.front;
      if (same_side || !opaque) {
        Ray shadow;
        shadow.origin = hit.position;
        shadow.direction = to_sun;
        shadow.from = hit.id;
        lit = !(stage.sun_rays ? stage.sun_rays->occluded(hit.position, hit.id) : scene.occluded(shadow));
        ++tally.counts.rays;
        const Factor factor =
            same_side ? reflectance_factor(hit.material, hit.front) : transmittance_factor(hit.material);
        if (lit) tally.add_sun(order + 1, weight, factor, std::abs(cosine) * inverse_pi, hit.ground);
      }
    }
    if (order == 0) ++(lit ? tally.counts.sunlit : tally.counts.shaded)[hit.material];
    if (order + 1 == sampling.max_order) return;

    const InteractionNumbers random = numbers.interaction(static_cast<std::uint32_t>(order));
    const float share = optics.reflect_share[hit.material][hit.front ? 0 : 1];
    const bool reflect = random.side < static_cast<double>(share);
    if (reflect)
      tally.scatter(weight, reflectance_factor(hit.material, hit.front), 1.0f / share);
    else
      tally.scatter(weight, transmittance_factor(hit.material), 1.0f / (1.0f - share));
    const float strength = weight.guide.largest();
    if (!(strength > 0)) return;
    // Roulette as absorption would do it: variance x cost is least where the chance to go on follows the
    // weight. Where a first hit is cheap, fewer of them are followed; the sky is seen by the ray that goes on
    // from the first hit, which is then worth its cost.
    const float share_followed = view_rays != nullptr ? followed : 1.0f;
    const float survival = order > 0 ? strength : light.sky ? 1.0f : strength * share_followed;
    if (sampling.roulette && survival < 1.0f) {
      if (random.survival >= static_cast<double>(survival)) return;
      tally.scale(weight, 1.0f / survival);
    }
    const Eigen::Vector3f outward =
        hit.front == reflect ? hit.geometric_normal : Eigen::Vector3f(-hit.geometric_normal);
    ray = Ray{};
    ray.origin = hit.position;
    ray.direction = cosine_direction(outward, random.direction_u, random.direction_v);
    ray.from = hit.id;
  }
}

}  // namespace

Stage make_stage(const Simulation& simulation, const Intersector& intersector) {
  Stage out{&intersector, &simulation, make_optics(simulation), extent_of(intersector), nullptr};
  if (simulation.light.sun)
    out.sun_rays = intersector.parallel_rays(simulation.scene, simulation.light.sun->direction);
  return out;
}

template <class Tally>
void trace_paths(const Stage& stage, const Sensor& sensor, std::size_t view, const ParallelRays* view_rays,
                 PathNumbers numbers, std::uint64_t first, std::uint64_t last, Tally& tally) {
  tally.counts.sunlit.resize(stage.optics.opaque.size());
  tally.counts.shaded.resize(stage.optics.opaque.size());
  constexpr std::uint64_t look_up = 63;  // how often to look for an interrupt
  for (std::uint64_t sample = first; sample < last; ++sample) {
    if ((sample & look_up) == 0 && interrupted()) return;
    numbers.start(sample);
    const auto [u, v] = numbers.position();
    trace_path(stage, sensor.start(view, u, v, stage.extent), view_rays, numbers, tally);
    ++tally.counts.paths;
  }
}

template void trace_paths(const Stage&, const Sensor&, std::size_t, const ParallelRays*, PathNumbers,
                          std::uint64_t, std::uint64_t, LaneTally&);
template void trace_paths(const Stage&, const Sensor&, std::size_t, const ParallelRays*, PathNumbers,
                          std::uint64_t, std::uint64_t, InteractionTally&);

}  // namespace bpms
