// The gap probability P(s) towards each sun: the share of parallel rays along the sun's direction that start
// evenly over the horizontal cell at the canopy top (the box of an open scene) and meet no canopy on their
// way to the ground or out. 32 batches of Owen-scrambled Sobol points; their spread is the standard error.
// Where no ray or every ray met the canopy it is 1 / (rays + 1).
#pragma once
#include "simulate/simulate.h"

namespace bpms {

inline constexpr std::uint32_t sun_gap_rays = 1u << 16;  // for each sun
Estimates sun_gap(const Light& light, const Intersector& intersector, std::uint64_t seed);

}  // namespace bpms
