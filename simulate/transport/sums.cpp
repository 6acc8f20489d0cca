#include "simulate/transport/sums.h"

#include <cmath>

namespace bpms {

void ViewCounts::merge(const ViewCounts& other) {
  paths += other.paths, rays += other.rays, lost += other.lost, gap += other.gap;
  sunlit.resize(other.sunlit.size());
  shaded.resize(other.shaded.size());
  for (std::size_t m = 0; m < sunlit.size(); ++m) sunlit[m] += other.sunlit[m], shaded[m] += other.shaded[m];
}

double Moments::standard_error(std::size_t index, std::size_t batches) const {
  const auto n = static_cast<double>(batches);
  return std::sqrt(squares_[index] / ((n - 1.0) * n));
}

}  // namespace bpms
