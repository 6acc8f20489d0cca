// Gap fraction P(zenith) by rays: the share of the footprint from which the sky is seen at that zenith angle,
// averaged over all azimuths. Rays start uniformly on the ground (the lowest point without one) and look up;
// a periodic scene is infinite. Points are 32 independent Owen-scrambled Sobol sets, whose spread gives the
// standard error; where no set saw both gap and leaf it is 1 / (rays + 1). The same bits on any number of
// threads.
#pragma once
#include <cstdint>
#include <vector>

#include "scene/intersect/intersector.h"
#include "scene/structure/footprint.h"

namespace bpms {

struct GapOptions {
  std::uint32_t rays = 1u << 16;  // for each angle; rounded up to 32 x 2^k
  std::uint64_t seed = 1;
};
struct Gap {
  double zenith_deg = 0;
  double p = 0;
  double standard_error = 0;
};
std::vector<Gap> gap_fraction(const Intersector& intersector, const Footprint& footprint,
                              const Ground& ground, const std::vector<double>& zenith_deg,
                              const GapOptions& options = {});

std::vector<double> usual_gap_angles_deg();  // 0, 5, ... 85 and 57.5

}  // namespace bpms
