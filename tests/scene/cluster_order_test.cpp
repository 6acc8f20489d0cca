#include "scene/geometry/cluster_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/random.h"

namespace bpms::test {
namespace {

std::vector<Eigen::Vector3f> random_points(std::size_t count) {
  Philox random(3, 1);
  std::vector<Eigen::Vector3f> out;
  for (std::size_t i = 0; i < count; ++i)
    out.emplace_back(random.uniform(0, 10), random.uniform(0, 10), random.uniform(0, 1));
  return out;
}

TEST(ClusterOrder, IsAPermutation) {
  for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 1000u}) {
    const auto order = cluster_order(random_points(count), 8);
    const std::set<std::uint32_t> seen(order.begin(), order.end());
    EXPECT_EQ(order.size(), count);
    EXPECT_EQ(seen.size(), count);
    EXPECT_TRUE(count == 0 || *seen.rbegin() == count - 1);
  }
}

// Eight of 8 000 points in 10 x 10 x 1 would fill a cube of side 0.46; points in any other order are metres
// apart.
TEST(ClusterOrder, KeepsClustersSmall) {
  const std::vector<Eigen::Vector3f> points = random_points(8000);
  const auto order = cluster_order(points, 8);
  double mean = 0;
  for (std::size_t from = 0; from < order.size(); from += 8) {
    Eigen::Vector3f low = points[order[from]], high = low;
    for (std::size_t i = from; i < from + 8; ++i)
      low = low.cwiseMin(points[order[i]]), high = high.cwiseMax(points[order[i]]);
    mean += static_cast<double>((high - low).maxCoeff()) / 1000;
  }
  EXPECT_LT(mean, 0.8);
}

// Points that coincide are told apart by their numbers.
TEST(ClusterOrder, TakesEqualPoints) {
  const std::vector<Eigen::Vector3f> points(100, Eigen::Vector3f::Ones());
  EXPECT_EQ(cluster_order(points, 8), cluster_order(points, 8));
}

}  // namespace
}  // namespace bpms::test
