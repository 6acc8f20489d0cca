// The yardstick: what anyone would write in an hour on Embree. One ray at a time, one shadow ray an
// interaction, independent random numbers, roulette on small weights only; discs, ground and a periodic cell,
// no more.
#pragma once
#include <cstdint>
#include <memory>

#include "simulate/simulate.h"

namespace bpms::bench {

struct PlainResult {
  double mean[2], variance[2];  // of one path
  double seconds;               // of the processor
};
// `paths` of one direction towards the sensor, in the principal plane; one band or two, material 0 the
// leaves' and 1 the soil's; all instances written out; build time not counted.
PlainResult trace_plainly(const Simulation& simulation, double vza_deg, std::uint64_t paths,
                          std::uint64_t seed);

// The same for several directions of one scene, which is built once and must outlive it.
class PlainTracer {
 public:
  explicit PlainTracer(const Simulation& simulation);
  ~PlainTracer();
  PlainResult trace(double vza_deg, std::uint64_t paths, std::uint64_t seed) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bpms::bench
