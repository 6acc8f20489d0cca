// BRF of many views from shared photon paths. The sun's light of order 1 comes by each view's own rays (first
// hits, and from there the sun), all other light by the vertices of photon paths that all views share. Both
// come in `batches` batches; how many of each a view takes is chosen for the least work to its target.
// Views that share paths are correlated: their covariance comes with the result.
#pragma once
#include <chrono>
#include <vector>

#include "simulate/simulate.h"

namespace bpms {

struct SharedViews {
  SensorResult result;
  std::vector<double> covariance;  // of the totals: bands x views x views, in units of radiance squared
  std::string stopped_by;          // target_se, samples, max_samples, max_seconds, interrupt
};

// Whether a sensor's views can share paths in this scene; where not, `why` says what is in the way.
bool can_share_paths(const Simulation& simulation, const Sensor& sensor, std::string* why = nullptr);

SharedViews trace_shared_views(
    const Simulation& simulation, const Intersector& intersector, const Sensor& sensor, std::uint64_t seed,
    std::uint32_t sensor_index,
    std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max());

}  // namespace bpms
