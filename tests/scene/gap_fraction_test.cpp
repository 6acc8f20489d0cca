// Gaps by rays: against closed forms, against themselves, and their standard errors.
#include "scene/structure/gap_fraction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel.h"
#include "core/units.h"
#include "scene/geometry/random_discs.h"

namespace bpms {
namespace {

RandomDiscs small_canopy() {
  RandomDiscs what;
  what.size_m = {3, 3};
  return what;
}

// A wall of height h along y through the middle of a cell, as a leaf.
Scene wall(double height, double width, std::string kind = "leaf") {
  Scene scene;
  scene.domain.size_m = {width, width};
  scene.materials = {"leaf"};
  auto mesh = std::make_shared<Mesh>();
  const auto h = static_cast<float>(height), w = static_cast<float>(width / 2);
  mesh->positions_m = {{0, -w, 0}, {0, w, 0}, {0, w, h}, {0, -w, h}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh->organ_of_triangle = {0, 0};
  mesh->organs.push_back({0, "wall", std::move(kind), "leaf", 0, height * width});
  scene.prototypes.emplace_back().mesh = mesh;
  scene.prototypes[0].material_of_organ = {0};
  scene.instances.emplace_back();
  return scene;
}

TEST(GapFraction, IsTheSameOnSevenThreadsAsOnOne) {
  const GapScene scene(random_disc_scene(small_canopy()));
  const auto with = [&](int count) {
    set_threads(count);
    auto out = gap_fraction(scene, gap_directions(usual_gap_angles_deg()), {1u << 11, 5});
    set_threads(0);
    return out;
  };
  const std::vector<Gap> one = with(1), seven = with(7);
  ASSERT_EQ(one.size(), seven.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].plant.p, seven[k].plant.p);
    EXPECT_EQ(one[k].plant.standard_error, seven[k].plant.standard_error);
  }
}

// Against a run with 64 times the rays. Squared deviations in standard errors of 32 batches have the mean
// 31/29 (Student's t); of 160 of them the mean is off by 4 times sqrt(2.3 / 160) at most.
TEST(GapFraction, StandardErrorsAreHonest) {
  const GapScene scene(random_disc_scene(small_canopy()));
  const std::vector<GapDirection> directions = gap_directions({0, 20, 40, 60});
  const std::vector<Gap> truth = gap_fraction(scene, directions, {1u << 18, 99});
  double squares = 0;
  int all = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const std::vector<Gap> gaps = gap_fraction(scene, directions, {1u << 12, seed});
    for (std::size_t k = 0; k < directions.size(); ++k, ++all)
      squares += std::pow((gaps[k].plant.p - truth[k].plant.p) /
                              std::hypot(gaps[k].plant.standard_error, truth[k].plant.standard_error),
                          2);
  }
  EXPECT_NEAR(squares / all, 31.0 / 29, 4 * std::sqrt(2.3 / all));
}

TEST(GapFraction, OfLeavesIsThatOfTheSceneWithoutTheRest) {
  RandomDiscs what = small_canopy();
  what.lai = 1;
  Scene scene = random_disc_scene(what);
  const Scene leaves = scene;
  Scene stems = scene;
  stems.prototypes[0].discs.clear();
  scene.prototypes[0].shapes.push_back(cylinder({0.3, 0.2, 0}, {0.3, 0.2, 1.5}, 0.2, 0.1));
  stems.prototypes[0].shapes = scene.prototypes[0].shapes;
  const std::vector<GapDirection> directions = gap_directions({0, 30, 70});
  const auto gaps = [&](const Scene& of) { return gap_fraction(GapScene(of), directions, {1u << 12, 3}); };
  const std::vector<Gap> both = gaps(scene), leaf = gaps(leaves), stem = gaps(stems);
  for (std::size_t k = 0; k < both.size(); ++k) {
    EXPECT_EQ(both[k].leaves.p, leaf[k].plant.p);  // the same rays
    EXPECT_EQ(both[k].others.p, stem[k].plant.p);
    EXPECT_EQ(leaf[k].others.p, 1);
    EXPECT_LT(both[k].plant.p, both[k].leaves.p);
    EXPECT_GE(both[k].plant.p, both[k].leaves.p + both[k].others.p - 1);
  }
}

// P = 1 - h/s tan t |sin(phi - phi_row)| behind walls of height h, s apart, until it is 0.
TEST(GapFraction, BetweenWallsIsTheirShadowByAzimuth) {
  const GapScene scene(wall(0.5, 1));
  constexpr int sectors = 24;
  for (const double zenith_deg : {20.0, 50.0, 75.0}) {
    const std::vector<Gap> gaps = gap_fraction(scene, gap_directions({zenith_deg}, sectors), {1u << 13, 1});
    ASSERT_EQ(gaps.size(), static_cast<std::size_t>(sectors));
    double all = 0;
    for (const Gap& gap : gaps) {
      double expected = 0;
      constexpr int steps = 1000;
      for (int i = 0; i < steps; ++i) {
        const double azimuth = gap.direction.azimuth + gap.direction.width * (i + 0.5) / steps;
        expected +=
            std::max(0.0, 1 - 0.5 * std::tan(radians(zenith_deg)) * std::abs(std::cos(azimuth))) / steps;
      }
      all += expected / sectors;
      EXPECT_NEAR(gap.plant.p, expected, 5 * gap.plant.standard_error + 1e-4)
          << degrees(gap.direction.azimuth);
    }
    const std::vector<Gap> mean = mean_over_azimuth(gaps, sectors);
    ASSERT_EQ(mean.size(), 1u);
    EXPECT_NEAR(mean[0].plant.p, all, 4 * mean[0].plant.standard_error);
    EXPECT_LT(mean[0].plant.standard_error, 0.002);
    const Gap whole = gap_fraction(scene, gap_directions({zenith_deg}), {1u << 13, 1})[0];
    EXPECT_NEAR(whole.plant.p, all, 4 * whole.plant.standard_error);
  }
}

TEST(GapFraction, DoesNotDependOnTheScale) {
  const Scene scene = random_disc_scene(small_canopy());
  Scene larger = scene;
  larger.domain.size_m *= 2;
  larger.instances[0].scale = 2;
  const std::vector<GapDirection> directions = gap_directions({0, 57.5, 80});
  const std::vector<Gap> one = gap_fraction(GapScene(scene), directions, {1u << 13, 2});
  const std::vector<Gap> two = gap_fraction(GapScene(larger), directions, {1u << 13, 2});
  // The same rays but for rounding: of 8192, a few at the rims of discs.
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(one[k].plant.p, two[k].plant.p, 1e-3);
}

// Rows of discs, as one period and as 3 x 3 of them.
TEST(GapFraction, OfRowsDoesNotDependOnHowManyTheCellHolds) {
  RandomDiscs what;
  what.size_m = {0.4, 0.5};  // narrower than the row distance
  what.lai = 4;
  what.radius_m = 0.03;
  what.top_m = 0.7;
  Scene scene = random_disc_scene(what);
  scene.domain.size_m = {1, 0.5};
  Scene many = scene;
  many.domain.size_m = {3, 1.5};
  many.instances.clear();
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y) many.instances.emplace_back().position_m = {1.0 * x, 0.5 * y, 0};
  const std::vector<GapDirection> directions = gap_directions({0, 30, 60}, 4);
  const std::vector<Gap> one = gap_fraction(GapScene(scene), directions, {1u << 15, 2});
  const std::vector<Gap> nine = gap_fraction(GapScene(many), directions, {1u << 15, 4});
  for (std::size_t k = 0; k < one.size(); ++k) {
    const double se = std::hypot(one[k].plant.standard_error, nine[k].plant.standard_error);
    EXPECT_NEAR(one[k].plant.p, nine[k].plant.p, 4 * se) << k;
    EXPECT_LT(se, 0.01);
  }
  // Along the rows (y, the second sector) more is seen of the sky than across.
  EXPECT_GT(one[9].plant.p, one[8].plant.p + 0.05);
}

TEST(GapFraction, StopsAtItsTarget) {
  const GapScene scene(random_disc_scene(small_canopy()));
  const std::vector<Gap> gaps = gap_fraction(scene, gap_directions({0, 40}), {1u << 22, 1, 0.004});
  for (const Gap& gap : gaps) {
    EXPECT_LE(gap.plant.standard_error, 0.004);
    EXPECT_LT(gap.rays, 1u << 16);
    EXPECT_EQ(gap.rays % 32, 0u);
  }
  // What was traced in steps is what is traced at once.
  const Gap at_once =
      gap_fraction(scene, gap_directions({0}), {static_cast<std::uint32_t>(gaps[0].rays), 1})[0];
  EXPECT_EQ(at_once.plant.p, gaps[0].plant.p);
  // At most `rays`, whatever the target.
  EXPECT_EQ(gap_fraction(scene, gap_directions({0}), {4096, 1, 1e-6})[0].rays, 4096u);
}

// De Wit's planophile leaves: 2 int P cos sin dt, as the mean of P over steps of sin^2 t (which is off by
// 3e-5 here), within 3 standard errors from the spread of 8 canopies.
TEST(RandomDiscs, HaveTheDiffuseTransmittanceOfTheirDistribution) {
  const struct {
    LeafAngles angles;
    double lai, expected;
  } rows[] = {{LeafAngles::spherical, 1, .4432},
              {LeafAngles::planophile, 3, .0638},
              {LeafAngles::erectophile, 3, .1302}};
  std::vector<GapDirection> directions;
  constexpr int steps = 16, canopies = 8;
  for (int i = 0; i < steps; ++i) {
    GapDirection& direction = directions.emplace_back();
    direction.zenith = direction.zenith_to = std::asin(std::sqrt((i + 0.5) / steps));
  }
  for (const auto& row : rows) {
    double sum = 0, squares = 0;
    for (int c = 0; c < canopies; ++c) {
      RandomDiscs what;
      what.lai = row.lai;
      what.angles = row.angles;
      what.size_m = {5, 5};
      what.radius_m = 0.03;
      what.bottom_m = what.radius_m;
      what.seed = 500 + static_cast<std::uint64_t>(c);
      double mean = 0;
      for (const Gap& gap :
           gap_fraction(GapScene(random_disc_scene(what)), directions, {1u << 11, what.seed}))
        mean += gap.plant.p / steps;
      sum += mean;
      squares += mean * mean;
    }
    const double mean = sum / canopies;
    const double se = std::sqrt((squares / canopies - mean * mean) / (canopies - 1));
    EXPECT_NEAR(mean, row.expected, 3 * se + 1e-4) << name_of(row.angles);
    EXPECT_LT(se, 0.004);
  }
}

}  // namespace
}  // namespace bpms
