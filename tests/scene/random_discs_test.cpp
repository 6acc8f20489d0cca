#include "scene/geometry/random_discs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel.h"
#include "core/units.h"
#include "scene/structure/gap_fraction.h"
#include "scene/structure/structure.h"

namespace bpms {
namespace {

// De Wit (1965) by Gauss-Legendre quadrature, four digits.
struct Row {
  LeafAngles angles;
  double mean_deg;
  double g[8];  // at 0 15 30 45 57.5 60 75 90 degrees
};
constexpr double table_angles[] = {0, 15, 30, 45, 57.5, 60, 75, 90};
constexpr Row g_table[] = {
    {LeafAngles::planophile, 26.76, {.8488, .8201, .7381, .6154, .4969, .4729, .3409, .2702}},
    {LeafAngles::erectophile, 63.24, {.4244, .4316, .4514, .4794, .5041, .5088, .5316, .5404}},
    {LeafAngles::plagiophile, 45.00, {.6791, .6567, .5990, .5295, .4803, .4725, .4408, .4323}},
    {LeafAngles::extremophile, 45.00, {.5942, .5950, .5905, .5653, .5206, .5092, .4317, .3783}},
    {LeafAngles::uniform, 45.00, {.6366, .6258, .5947, .5474, .5005, .4908, .4363, .4053}},
    {LeafAngles::spherical, 57.30, {.5, .5, .5, .5, .5, .5, .5, .5}},
};

TEST(LeafAngles, GiveTheTabulatedG) {
  for (const Row& row : g_table)
    for (int k = 0; k < 8; ++k)
      EXPECT_NEAR(g_function(row.angles, radians(table_angles[k])), row.g[k], 6e-5) << table_angles[k];
}

TEST(LeafAngles, QuantilesInvertTheDistribution) {
  for (const Row& row : g_table) {
    constexpr int steps = 20000;
    double mean = 0;
    for (int k = 0; k < steps; ++k)
      mean += degrees(leaf_angle_quantile(row.angles, (k + 0.5) / steps)) / steps;
    EXPECT_NEAR(mean, row.mean_deg, 0.01);
  }
}

// P = (1 - G a / (A cos t))^N over independent canopies: the spread between canopies gives the standard
// error.
void expect_gaps(LeafAngles angles, std::uint64_t first_seed) {
  constexpr int canopies = 16;
  const std::vector<double> zenith{0, 30, 57.5, 75};
  std::vector<double> sum(zenith.size()), squares(zenith.size());
  RandomDiscs what;
  what.lai = 2;
  what.radius_m = 0.05;
  what.size_m = {6, 6};
  what.bottom_m = what.radius_m;  // no disc dips into the ground
  what.top_m = 1.5;
  what.angles = angles;
  double discs = 0;
  for (int c = 0; c < canopies; ++c) {
    what.seed = first_seed + static_cast<std::uint64_t>(c);
    const Scene scene = random_disc_scene(what);
    discs = static_cast<double>(scene.prototypes[0].discs.size());
    const std::vector<Gap> gaps =
        gap_fraction(Intersector(scene), Footprint(scene), Ground{}, zenith, {1u << 14, what.seed});
    for (std::size_t k = 0; k < zenith.size(); ++k) {
      sum[k] += gaps[k].p;
      squares[k] += gaps[k].p * gaps[k].p;
    }
  }
  for (std::size_t k = 0; k < zenith.size(); ++k) {
    const double mean = sum[k] / canopies;
    const double se = std::sqrt((squares[k] / canopies - mean * mean) / (canopies - 1));
    const double t = radians(zenith[k]);
    const double shadow =
        g_function(angles, t) * pi * what.radius_m * what.radius_m / (what.size_m.prod() * std::cos(t));
    const double expected = std::pow(1 - shadow, discs);
    EXPECT_LT(std::abs(mean - expected), 4 * se)
        << zenith[k] << " degrees: " << mean << " +- " << se << ", expected " << expected;
    EXPECT_LT(se, 0.02 * expected + 1e-3);  // small enough to bite
  }
}

TEST(RandomDiscs, HaveTheGapFractionOfSphericalLeaves) {
  expect_gaps(LeafAngles::spherical, 100);
}
TEST(RandomDiscs, HaveTheGapFractionOfPlanophileLeaves) {
  expect_gaps(LeafAngles::planophile, 200);
}
TEST(RandomDiscs, HaveTheGapFractionOfErectophileLeaves) {
  expect_gaps(LeafAngles::erectophile, 300);
}

TEST(RandomDiscs, AreDescribedAsTheyWereMade) {
  RandomDiscs what;
  what.lai = 3;
  what.size_m = {10, 10};
  what.angles = LeafAngles::planophile;
  what.bottom_m = 0.05;
  const Scene scene = random_disc_scene(what);
  const CanopyStructure structure = canopy_structure(scene, {1u << 13, 1});
  EXPECT_NEAR(structure.lai, 3, 1e-3);
  EXPECT_NEAR(structure.height_m, 2, 0.06);
  const double n = static_cast<double>(scene.prototypes[0].discs.size());
  EXPECT_NEAR(structure.facets.mean_leaf_angle_deg, 26.76, 4 * 18.50 / std::sqrt(n));
  for (const auto& point : structure.facets.g_function) {
    const double g = g_function(what.angles, radians(point.zenith_deg));
    EXPECT_NEAR(point.g, g, 4 * 0.4 / std::sqrt(n)) << point.zenith_deg;
  }
  EXPECT_NEAR(structure.material_area_m2.at("leaf"), 300, 0.1);
}

TEST(Clumping, HalvesWhenEveryLeafIsHiddenByAnother) {
  // The same leaves once more in the same places: twice the leaf area behind the same gaps.
  RandomDiscs what;
  what.size_m = {4, 4};
  Scene scene = random_disc_scene(what);
  const CanopyStructure once = canopy_structure(scene, {1u << 12, 1});
  scene.instances.push_back(scene.instances[0]);
  const CanopyStructure twice = canopy_structure(scene, {1u << 12, 1});
  ASSERT_EQ(once.clumping.size(), twice.clumping.size());
  ASSERT_GT(once.clumping.size(), 5u);
  for (std::size_t k = 0; k < once.clumping.size(); ++k)
    EXPECT_NEAR(twice.clumping[k].index, 0.5 * once.clumping[k].index, 0.01 * once.clumping[k].index);
  EXPECT_NEAR(twice.lai, 2 * once.lai, 1e-9);
}

TEST(GapFraction, IsTheSameOnSevenThreadsAsOnOne) {
  RandomDiscs what;
  what.size_m = {3, 3};
  const Scene scene = random_disc_scene(what);
  const Intersector intersector(scene);
  const auto with = [&](int count) {
    set_threads(count);
    auto out = gap_fraction(intersector, Footprint(scene), Ground{}, usual_gap_angles_deg(), {1u << 11, 5});
    set_threads(0);
    return out;
  };
  const std::vector<Gap> one = with(1), seven = with(7);
  ASSERT_EQ(one.size(), seven.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].p, seven[k].p);
    EXPECT_EQ(one[k].standard_error, seven[k].standard_error);
  }
}

TEST(GapFraction, StandardErrorsCoverTheTruth) {
  // Against a run with 64 times the rays: in about 95 % within two standard errors; far less if they were too
  // small.
  RandomDiscs what;
  what.size_m = {3, 3};
  const Scene scene = random_disc_scene(what);
  const Intersector intersector(scene);
  const Footprint footprint(scene);
  const std::vector<double> zenith{0, 20, 40, 60};
  const std::vector<Gap> truth = gap_fraction(intersector, footprint, Ground{}, zenith, {1u << 18, 99});
  int inside = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const std::vector<Gap> gaps = gap_fraction(intersector, footprint, Ground{}, zenith, {1u << 12, seed});
    for (std::size_t k = 0; k < zenith.size(); ++k, ++all)
      inside += std::abs(gaps[k].p - truth[k].p) <
                2.04 * std::hypot(gaps[k].standard_error, truth[k].standard_error);
  }
  EXPECT_GT(inside, 0.88 * all);  // 95 % of 160 less four binomial standard deviations
}

}  // namespace
}  // namespace bpms
