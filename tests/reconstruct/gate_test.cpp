#include "reconstruct/points/gate.h"

#include <gtest/gtest.h>

#include "tests/reconstruct/synthetic.h"

namespace bpms {
namespace {

TEST(Gate, TailOfChiSquare) {
  // Abramowitz & Stegun, table 26.8: percentage points.
  EXPECT_NEAR(chi_squared_tail(6.63490, 1), 0.01, 1e-7);
  EXPECT_NEAR(chi_squared_tail(5.99147, 2), 0.05, 1e-6);
  EXPECT_NEAR(chi_squared_tail(11.3449, 3), 0.01, 1e-6);
  EXPECT_NEAR(chi_squared_tail(20.5150, 5), 0.001, 1e-6);
  EXPECT_NEAR(chi_squared_tail(18.3070, 10), 0.05, 1e-6);
  EXPECT_EQ(chi_squared_tail(0, 3), 1);
  EXPECT_LT(chi_squared_tail(1e5, 3), 1e-300);
}

TEST(Gate, StereoChiSquareIsTheDistanceFromTheEpipolarLine) {
  const Rig rig = test::parallel_rig();
  for (const double dv : {0.3, 1.0, 2.0}) {
    const auto points = test::image_points(rig, 1,
                                           {{0,
                                             {
                                                 900,
                                                 600 + dv,
                                             },
                                             0.5},
                                            {1, {100, 600}, 0.5}});
    const auto found = reconstruct(points, rig).points.front();
    EXPECT_NEAR(found.estimate->chi2, dv * dv / (2 * 0.5 * 0.5), 1e-6);
    EXPECT_EQ(found.estimate->dof, 1);
    EXPECT_EQ(found.accepted(), dv < 1.82);  // chi2 < 6.635
  }
}

TEST(Gate, ABlunderInOneImageIsNamed) {
  Philox random(60);
  for (const Rig& rig : {test::parallel_rig(), test::convergent_rig(2), test::convergent_rig(3)}) {
    std::vector<ImagePoint> points;
    constexpr int blunder = 7;
    for (int i = 0; i < 20; ++i) {
      auto sightings = test::sight(rig, test::somewhere(random), 0.2, &random);
      if (i == blunder) sightings[0].pixel.y() += 10;
      const auto rows = test::image_points(rig, i, sightings);
      points.insert(points.end(), rows.begin(), rows.end());
    }
    const Vectors vectors = reconstruct(points, rig, {1e-4, true, {}});
    ASSERT_EQ(vectors.refused(), 1u);
    for (const ReconstructedPoint& p : vectors.points) {
      if (p.accepted()) continue;
      EXPECT_EQ(p.str(), "plant 1 axis 1 rank 1 leaf midrib point 7");
      EXPECT_EQ(p.reason, "chi2");
      EXPECT_EQ(p.where.line, 9);
      EXPECT_GT(p.estimate->chi2, 100);
    }
    EXPECT_EQ(vectors.accepted().size(), 19u);
  }
}

TEST(Gate, RefusesOnePercentOfGoodPoints) {
  const Rig rig = test::convergent_rig(2);
  Philox random(61);
  std::vector<ImagePoint> points;
  constexpr int count = 5000;
  for (int i = 0; i < count; ++i) {
    const auto rows = test::image_points(rig, i, test::sight(rig, test::somewhere(random), 0.5, &random));
    points.insert(points.end(), rows.begin(), rows.end());
  }
  const double share = static_cast<double>(reconstruct(points, rig).refused()) / count;
  EXPECT_NEAR(share, 0.01, 3 * std::sqrt(0.01 * 0.99 / count));
}

}  // namespace
}  // namespace bpms
