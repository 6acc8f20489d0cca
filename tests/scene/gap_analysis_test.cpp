// Clumping and effective leaf area from gaps whose truth is known.
#include "scene/structure/gap_analysis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "plant/structure/de_wit.h"

namespace bpms {
namespace {

std::vector<Gap> beer(LeafAngles angles, double lai, double se) {
  std::vector<Gap> out;
  for (const GapDirection& direction : gap_directions(usual_gap_angles_deg())) {
    Gap gap{direction, {}, {}, {}, 1000};
    gap.plant.p = std::exp(-g_function(angles, direction.zenith) * lai / std::cos(direction.zenith));
    gap.plant.standard_error = se * gap.plant.p;
    gap.leaves = {std::sqrt(gap.plant.p), 0};  // half the leaves
    out.push_back(gap);
  }
  return out;
}

TEST(GapAnalysis, MillersIntegralGivesTheAreaOfRandomLeaves) {
  // G sin t is linear between angles 5 degrees apart to some 1e-3.
  for (const LeafAngles angles : all_leaf_angles) {
    const auto miller = miller_lai(beer(angles, 3, 0), GapOf::plant);
    ASSERT_TRUE(miller);
    EXPECT_NEAR(miller->lai.value, 3, 0.006) << name_of(angles);
    EXPECT_NEAR(miller_lai(beer(angles, 3, 0), GapOf::leaves)->lai.value, 1.5, 0.003);
  }
  EXPECT_NEAR(miller_lai(beer(LeafAngles::spherical, 3, 0), GapOf::plant)->lai.value, 3, 1e-12);
}

TEST(GapAnalysis, StandardErrorsFollowFromThoseOfTheGaps) {
  // The analytic derivative against a step of one gap after the other.
  const std::vector<Gap> gaps = beer(LeafAngles::planophile, 2, 0.01);
  const WithError lai = miller_lai(gaps, GapOf::plant)->lai;
  double variance = 0;
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    std::vector<Gap> other = gaps;
    const double step = 1e-3 * other[k].plant.standard_error;
    other[k].plant.p += step;
    variance += std::pow(
        (miller_lai(other, GapOf::plant)->lai.value - lai.value) / step * other[k].plant.standard_error, 2);
  }
  EXPECT_NEAR(lai.standard_error, std::sqrt(variance), 1e-4 * lai.standard_error);
  const Gap& one = gaps[5];
  const WithError clumping = *clumping_index(one.plant, one.direction.zenith, 0.5, 2);
  EXPECT_NEAR(clumping.standard_error, 0.01 * std::cos(one.direction.zenith), 1e-12);
}

TEST(GapAnalysis, AngleWithoutGapsIsPassedOver) {
  std::vector<Gap> gaps = beer(LeafAngles::spherical, 3, 0);
  for (Gap& gap : gaps)
    if (gap.zenith_deg() > 70) gap.plant = {0, 1e-4};
  const auto miller = miller_lai(gaps, GapOf::plant);
  ASSERT_TRUE(miller);
  EXPECT_NEAR(miller->lai.value, 3, 1e-9);  // G does not change with the angle
  EXPECT_EQ(miller->last_zenith_deg, 70);
  EXPECT_FALSE(contact_number({0, 1e-4}, 0));
  EXPECT_FALSE(contact_number({1, 1e-4}, 0));
  for (Gap& gap : gaps) gap.plant = {0, 1e-4};
  EXPECT_FALSE(miller_lai(gaps, GapOf::plant));
}

// At 57.5 degrees the distributions' G lies between .480 and .521.
TEST(GapAnalysis, OneAngleTellsTheAreaOfAnyDistributionNearly) {
  for (const LeafAngles angles : all_leaf_angles) {
    const auto lai = lai_from_57(beer(angles, 3, 0), GapOf::plant);
    ASSERT_TRUE(lai);
    EXPECT_NEAR(lai->value, 3 * g_function(angles, radians(57.5)) / 0.5, 1e-9);
    EXPECT_NEAR(lai->value, 3, 0.13);
  }
}

TEST(GapAnalysis, RingsOfThePlantCanopyAnalyser) {
  std::vector<Gap> rings;
  const double centres[] = {7, 23, 38, 53, 68};
  const std::vector<GapDirection> directions = plant_canopy_analyser_rings();
  ASSERT_EQ(directions.size(), 5u);
  double last = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_LT(directions[k].zenith, radians(centres[k]));
    EXPECT_GT(directions[k].zenith_to, radians(centres[k]));
    EXPECT_GE(directions[k].zenith, last);
    last = directions[k].zenith_to;
    const double p = std::exp(-0.5 * 2.5 / std::cos(radians(centres[k])));
    rings.push_back({directions[k], {p, 0.01 * p}, {}, {}, 100});
  }
  const auto lai = plant_canopy_analyser_lai(rings, GapOf::plant);
  ASSERT_TRUE(lai);
  EXPECT_NEAR(lai->value, 2.5, 1e-9);  // its weights sum to 1
  EXPECT_FALSE(plant_canopy_analyser_lai(rings, GapOf::leaves));
}

}  // namespace
}  // namespace bpms
