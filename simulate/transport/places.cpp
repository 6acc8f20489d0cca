#include "simulate/transport/places.h"

#include <algorithm>
#include <array>

namespace bpms {

MortonCurve::MortonCurve(const Extent& extent)
    : low_(static_cast<float>(extent.low_m.x()), static_cast<float>(extent.low_m.y()),
           static_cast<float>(extent.bottom_m)) {
  const Eigen::Vector2d size = extent.high_m - extent.low_m;
  const double widest = std::max({size.x(), size.y(), extent.top_m - extent.bottom_m, 1e-6});
  cells_per_m_ = static_cast<float>(255.0 / widest);
}

void sort_places(std::vector<std::uint64_t>& places, std::vector<std::uint64_t>& spare) {
  constexpr std::size_t digits = 12, passes = 2, worth_counting = 4096;
  if (places.size() < worth_counting) {
    std::sort(places.begin(), places.end());
    return;
  }
  spare.resize(places.size());
  for (std::size_t pass = 0; pass < passes; ++pass) {
    std::array<std::uint32_t, (1u << digits) + 1> start{};
    const auto digit = [shift = 32 + pass * digits](std::uint64_t item) {
      return (item >> shift) & ((1u << digits) - 1);
    };
    for (const std::uint64_t item : places) ++start[digit(item) + 1];
    for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
    places.swap(spare);
    for (const std::uint64_t item : spare) places[start[digit(item)]++] = item;
  }
}

}  // namespace bpms
