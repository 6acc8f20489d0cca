#include "plant/structure/height_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "core/units.h"

namespace bpms {
namespace {

double total(const HeightProfile& profile) {
  double out = profile.below() + profile.above();
  for (std::size_t k = 0; k < profile.layers(); ++k) out += profile.area(k);
  return out;
}

// Against points spread evenly over the triangle: 4 binomial standard deviations.
TEST(HeightProfile, DividesTrianglesAsTheirPointsLie) {
  Philox random(3);
  for (int trial = 0; trial < 5; ++trial) {
    const std::array<double, 3> z{random.uniform(-0.3, 1.3), random.uniform(-0.3, 1.3),
                                  random.uniform(-0.3, 1.3)};
    HeightProfile profile(0, 1, 7);
    profile.add_triangle(z, 2.0);
    EXPECT_NEAR(total(profile), 2, 1e-12);
    constexpr int points = 100000;
    std::vector<int> count(7);
    int below = 0;
    for (int i = 0; i < points; ++i) {
      const double u = std::sqrt(random.uniform()), v = random.uniform();
      const double at = (1 - u) * z[0] + u * (1 - v) * z[1] + u * v * z[2];
      if (at < 0) ++below;
      if (at >= 0 && at < 1) ++count[static_cast<std::size_t>(at * 7)];
    }
    const double four_sigma = 4 * 2 * 0.5 / std::sqrt(points);
    for (std::size_t k = 0; k < 7; ++k)
      EXPECT_NEAR(profile.area(k), 2.0 * count[k] / points, four_sigma) << k;
    EXPECT_NEAR(profile.below(), 2.0 * below / points, four_sigma);
  }
}

TEST(HeightProfile, DividesDiscsByTheirSegments) {
  HeightProfile profile(0, 1, 2);
  profile.add_disc(0.5, 0.3, 1.0);  // halved
  EXPECT_NEAR(profile.area(0), 0.5, 1e-12);
  EXPECT_NEAR(profile.area(1), 0.5, 1e-12);
  HeightProfile other(0, 1, 2);
  other.add_disc(0.4, 0.2, 1.0);
  // The segment beyond half the radius: (acos(1/2) - 1/2 sqrt(3)/2) / pi.
  EXPECT_NEAR(other.area(1), (pi / 3 - std::sqrt(3) / 4) / pi, 1e-12);
}

TEST(HeightProfile, PutsLevelPiecesIntoOneLayerAndTheTopIntoTheLast) {
  HeightProfile profile(0, 1, 4);
  profile.add_triangle({0.25, 0.25, 0.25}, 1);
  profile.add_triangle({1, 1, 1}, 2);
  profile.add_disc(0, 0, 4);
  profile.add_disc(1.2, 0, 8);
  profile.add_disc(-0.1, 0, 16);
  EXPECT_EQ(profile.area(0), 4);
  EXPECT_EQ(profile.area(1), 1);
  EXPECT_EQ(profile.area(3), 2);
  EXPECT_EQ(profile.above(), 8);
  EXPECT_EQ(profile.below(), 16);
}

TEST(HeightProfile, ScalesAndRaisesAnother) {
  HeightProfile own(0, 1, 10), sum(0, 4, 4);
  own.add_slab(0, 1, 3);
  sum.add(own, 2, 1, 5);  // evenly from 1 to 3
  EXPECT_NEAR(sum.area(0), 0, 1e-12);
  EXPECT_NEAR(sum.area(1), 7.5, 1e-12);
  EXPECT_NEAR(sum.area(2), 7.5, 1e-12);
  EXPECT_NEAR(sum.area(3), 0, 1e-12);
}

}  // namespace
}  // namespace bpms
