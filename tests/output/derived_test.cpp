// What follows from a result, against the spread of repeated runs and the result itself. Closed forms:
// drawings_test.cpp.
#include "simulate/output/derived.h"

#include <gtest/gtest.h>

#include "core/units.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

constexpr double sza_deg = 40, lai = 1.5;

const RandomDiscs small_discs{
    .lai = lai, .radius_m = 0.02, .size_m = {2, 2}, .bottom_m = 0.2, .top_m = 2.2, .seed = 3};

Simulation canopy(const TemporaryFolder& folder, const std::string& samples, const std::string& sky = "") {
  SceneText text = canopy_text(folder, small_discs);
  text.sun = sun_at(sza_deg, 0);
  text.sky = sky;
  text.sensor = views("[[30, 90], [50, 180], [40, 0]]");  // far from the hot spot twice, and in it
  text.sampling = "samples = " + samples;
  return simulation_of(folder, text);
}

// Standard errors against the spread of 40 runs: its own relative error is 1 / sqrt(2 * 39) = 11 %. The
// overlap's is an upper bound.
TEST(Derived, StandardErrorsAreThoseOfRepeatedRuns) {
  const TemporaryFolder folder;
  const Simulation simulation = canopy(folder, "1024", white_sky);
  const Intersector intersector(simulation.scene);
  constexpr int runs = 40;
  const std::vector<double> fraction{0.3};
  double sums[2] = {}, squares[2] = {}, variances[2] = {}, apart = 0;
  for (int r = 0; r < runs; ++r) {
    const Result result = simulate(simulation, intersector, static_cast<std::uint64_t>(r + 1));
    const Estimates overlap = overlap_function(simulation, result, 0);
    const Estimates mixed = recombined_reflectance(simulation, result.sensors[0], fraction);
    const Estimates* of[2] = {&overlap, &mixed};
    for (int k = 0; k < 2; ++k) {
      sums[k] += of[k]->value[0];
      squares[k] += of[k]->value[0] * of[k]->value[0];
      variances[k] += of[k]->standard_error[0] * of[k]->standard_error[0] / runs;
    }
    apart += result.sensors[0].direct_diffuse_covariance[0];
  }
  const auto spread = [&](int k) { return (squares[k] - sums[k] * sums[k] / runs) / (runs - 1); };
  EXPECT_LT(std::sqrt(spread(0) / variances[0]), 1 + 4 * 0.11);
  EXPECT_NEAR(std::sqrt(spread(1) / variances[1]), 1.0, 4 * 0.11);
  EXPECT_NE(apart, 0.0);
}

// At the scene's own diffuse fraction the recombined reflectance is the run's own total, errors too.
TEST(Derived, RecombinesToTheSceneItself) {
  const TemporaryFolder folder;
  const Simulation simulation = canopy(folder, "2048", white_sky);
  const Result result = simulate(simulation, 1);
  const double direct = simulation.light.direct_irradiance(1)[0],
               diffuse = simulation.light.diffuse_irradiance(1)[0];
  const Estimates mixed =
      recombined_reflectance(simulation, result.sensors[0], {diffuse / (direct + diffuse)});
  const double scale = pi / (direct + diffuse);
  for (std::size_t view = 0; view < 3; ++view) {
    EXPECT_NEAR(mixed.value[view], result.sensors[0].radiance[0].value[view] * scale, 1e-12);
    EXPECT_NEAR(mixed.standard_error[view], result.sensors[0].radiance[0].standard_error[view] * scale,
                1e-12);
  }
}

TEST(Derived, OrdersDecayAndTheEnoughOneIsEnough) {
  const TemporaryFolder folder;
  Simulation simulation = canopy(folder, "8192");
  const Result whole = simulate(simulation, 1);
  const OrderDecay decay = order_decay(simulation, whole.sensors[0]).at(0);
  ASSERT_TRUE(decay.enough_order.has_value());
  EXPECT_GT(*decay.enough_order, 3);
  for (std::size_t n = 0; n < decay.ratio.size() && n < 6; ++n) {
    EXPECT_GT(decay.ratio[n], 0.0);
    EXPECT_LT(decay.ratio[n], 0.9);  // the single-scattering albedo of the leaves is the largest there can be
  }
  simulation.sampling.max_order = *decay.enough_order;
  const Result cut = simulate(simulation, 1);
  for (std::size_t view = 0; view < 3; ++view) {
    const Estimates &a = whole.sensors[0].radiance[0], &b = cut.sensors[0].radiance[0];
    EXPECT_NEAR(a.value[view], b.value[view], 4 * a.standard_error[view]);
  }
}

TEST(Derived, NothingIsMadeUpWithoutLeavesOrInAnOpenDomain) {
  const TemporaryFolder folder;
  SceneText text{.soil = lambertian("0.2"),
                 .sun = sun_at(30, 0),
                 .sensor = views("[[0, 0]]"),
                 .sampling = "samples = 64"};
  const Simulation bare = simulation_of(folder, text);
  const Result result = simulate(bare, 1);
  EXPECT_EQ(result.sun_gap.value.at(0), 1.0);
  EXPECT_TRUE(effective_g(bare, result, 0).value.empty());
  EXPECT_TRUE(effective_gamma(bare, result, 0).value.empty());
  text.domain += "\nboundary = \"open\"";
  const Simulation open = simulation_of(folder, text);
  EXPECT_TRUE(overlap_function(open, simulate(open, 1), 0).value.empty());
}

}  // namespace
}  // namespace bpms::test
