#include "scene/geometry/morton.h"

#include <algorithm>
#include <numeric>

namespace bpms {
namespace {

// Spreads the low 21 bits so that two zero bits follow each.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x001f00000000ffffull;
  x = (x | x << 16) & 0x001f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  x = (x | x << 2) & 0x1249249249249249ull;
  return x;
}

}  // namespace

std::vector<std::uint32_t> morton_order(std::span<const Eigen::Vector3f> points) {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(3e38f), high = -low;
  for (const Eigen::Vector3f& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const float extent = points.empty() ? 1 : std::max((high - low).maxCoeff(), 1e-30f);
  std::vector<std::uint64_t> code;
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3f q = (p - low) / extent * 2097151.0f;  // 2^21 - 1
    code.push_back(spread(static_cast<std::uint64_t>(q.x())) |
                   spread(static_cast<std::uint64_t>(q.y())) << 1 |
                   spread(static_cast<std::uint64_t>(q.z())) << 2);
  }
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return code[a] < code[b]; });
  return order;
}

}  // namespace bpms
