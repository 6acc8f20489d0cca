#include "simulate/transport/sums.h"

#include <cmath>

namespace bpms {

void ViewCounts::resize(std::size_t suns, std::size_t materials) {
  sunlit.resize(suns * materials);
  shaded.resize(suns * materials);
  lit_behind.resize(suns * materials);
  sunlit_ground.resize(suns);
}

void ViewCounts::merge(const ViewCounts& other) {
  paths += other.paths, rays += other.rays, lost += other.lost, gap += other.gap;
  const auto add = [](std::vector<std::uint64_t>& to, const std::vector<std::uint64_t>& from) {
    to.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) to[i] += from[i];
  };
  add(sunlit, other.sunlit);
  add(shaded, other.shaded);
  add(lit_behind, other.lit_behind);
  add(sunlit_ground, other.sunlit_ground);
}

double Moments::standard_error(std::size_t index, std::size_t batches) const {
  const auto n = static_cast<double>(batches);
  return std::sqrt(squares_[index] / ((n - 1.0) * n));
}

}  // namespace bpms
