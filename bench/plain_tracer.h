// The yardstick: what anyone would write in an hour on Embree. One ray at a time, one shadow ray an
// interaction, independent random numbers, roulette on small weights only; discs, ground and a periodic cell,
// no more.
#pragma once
#include <cstdint>

#include "simulate/simulate.h"

namespace bpms::bench {

struct PlainResult {
  double mean[2], variance[2];  // of one path
  double seconds;               // of the processor
};
// `paths` of one direction towards the sensor; two bands; build time not counted.
PlainResult trace_plainly(const Simulation& simulation, double vza_deg, std::uint64_t paths,
                          std::uint64_t seed);

}  // namespace bpms::bench
