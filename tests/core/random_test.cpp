#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace bpms {
namespace {

// Random123's published known answer for Philox4x32-10 with all-zero key and counter.
TEST(Random, PhiloxKnownAnswer) {
  const auto out = philox(0, 0, 0);
  EXPECT_EQ(out[0], 0x6627e8d5u);
  EXPECT_EQ(out[1], 0xe169c58du);
  EXPECT_EQ(out[2], 0xbc57ac4cu);
  EXPECT_EQ(out[3], 0x9b00dbd8u);
}

TEST(Random, UniformAndNormalHaveTheirMoments) {
  Philox generator(3, 5);
  constexpr int n = 200'000;
  double sum = 0, sum2 = 0, normal = 0, normal2 = 0;
  for (int i = 0; i < n; ++i) {
    const double u = generator.uniform();
    ASSERT_GT(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    sum2 += u * u;
    const double z = generator.normal();
    normal += z;
    normal2 += z * z;
  }
  constexpr double z_limit = 4;  // standard errors
  EXPECT_NEAR(sum / n, 0.5, z_limit * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(sum2 / n, 1.0 / 3, z_limit * std::sqrt(4.0 / 45 / n));
  EXPECT_NEAR(normal / n, 0, z_limit / std::sqrt(n));
  EXPECT_NEAR(normal2 / n, 1, z_limit * std::sqrt(2.0 / n));
}

// Every dimension of 2^k points, scrambled or not, has exactly one point in each interval of length 2^-k.
TEST(Random, SobolIsStratifiedInEveryDimension) {
  constexpr std::uint32_t n = 1024;
  for (int dimension = 0; dimension < 4 * sobol_dimensions; ++dimension) {
    std::set<int> plain, scrambled;
    for (std::uint32_t i = 0; i < n; ++i) {
      if (dimension < sobol_dimensions) plain.insert(static_cast<int>(sobol(i, dimension) >> 22));
      scrambled.insert(static_cast<int>(sobol_owen(i, dimension, 99) * n));
    }
    if (dimension < sobol_dimensions) {
      EXPECT_EQ(plain.size(), n) << dimension;
    }
    EXPECT_EQ(scrambled.size(), n) << dimension;
  }
}

// The first two dimensions of a group form a (0, 2)-sequence: one point in every elementary box of area 1/n.
TEST(Random, FirstTwoDimensionsStratifyBoxes) {
  constexpr std::uint32_t n = 256;
  for (int split = 0; split <= 8; ++split) {
    std::set<std::pair<int, int>> boxes;
    for (std::uint32_t i = 0; i < n; ++i) {
      boxes.insert({static_cast<int>(sobol_owen(i, 4, 7) * (1 << split)),
                    static_cast<int>(sobol_owen(i, 5, 7) * (1 << (8 - split)))});
    }
    EXPECT_EQ(boxes.size(), n) << split;
  }
}

// An integral whose variance under plain Monte Carlo is known falls much faster with scrambled points,
// without bias.
TEST(Random, ScrambledPointsIntegrateWithoutBias) {
  constexpr int scrambles = 64;
  constexpr std::uint32_t n = 256;
  double sum = 0, sum2 = 0;
  for (int s = 0; s < scrambles; ++s) {
    double mean = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      mean += std::exp(-sobol_owen(i, 0, static_cast<std::uint64_t>(s)) -
                       sobol_owen(i, 1, static_cast<std::uint64_t>(s))) /
              n;
    }
    sum += mean;
    sum2 += mean * mean;
  }
  const double truth = std::pow(1 - std::exp(-1.0), 2);
  const double sd = std::sqrt((sum2 - sum * sum / scrambles) / (scrambles - 1));
  EXPECT_NEAR(sum / scrambles, truth, 4 * sd / std::sqrt(scrambles));
  constexpr double plain_sd = 0.166 / 16;  // sd of exp(-x-y) over sqrt(256)
  EXPECT_LT(sd, plain_sd / 10);
}

}  // namespace
}  // namespace bpms
