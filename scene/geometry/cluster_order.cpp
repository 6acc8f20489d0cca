#include "scene/geometry/cluster_order.h"

#include <algorithm>
#include <numeric>

namespace bpms {
namespace {

void halve(std::span<const Eigen::Vector3f> points, std::span<std::uint32_t> order, std::size_t size) {
  if (order.size() <= size) return;
  Eigen::Vector3f low = points[order[0]], high = low;
  for (const std::uint32_t k : order) low = low.cwiseMin(points[k]), high = high.cwiseMax(points[k]);
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t clusters = (order.size() + size - 1) / size, half = (clusters + 1) / 2 * size;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     const float x = points[a][axis], y = points[b][axis];
                     return x != y ? x < y : a < b;
                   });
  halve(points, order.first(half), size);
  halve(points, order.subspan(half), size);
}

}  // namespace

std::vector<std::uint32_t> cluster_order(std::span<const Eigen::Vector3f> points, std::size_t size) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  halve(points, order, size);
  return order;
}

}  // namespace bpms
