// Irradiance at levels of a canopy of black leaves: the direct transmittance exp(-G LAI(z) / mu), LAI(z) what
// stands above. N discs of area a over a ground A let through (1 - G a / (A mu))^N exactly; one canopy is one
// draw, the error that between canopies.
#include "tests/physics/physics.h"

namespace bpms::test {
namespace {

Mean transmittance(double sza, double height_m, const RandomDiscs& what) {
  constexpr int canopies = 12;
  std::vector<double> draws;
  for (std::uint64_t seed = 1; seed <= canopies; ++seed) {
    const TemporaryFolder folder;
    RandomDiscs discs = what;
    discs.seed = seed;
    SceneText scene = canopy_text(folder, discs);
    scene.leaf = bilambertian("0", "0");
    scene.sun = sun_at(sza, 30.0 * static_cast<double>(seed));
    scene.sensor = looking_up(height_m);
    scene.sampling = "samples = 32768";
    draws.push_back(estimate_of(run_of(folder, scene, "", seed)).value);
  }
  return mean_of(draws);
}

TEST(Levels, DirectTransmittanceFallsExponentially) {
  const RandomDiscs what{.lai = 1.5, .radius_m = 0.02, .size_m = {2, 2}, .bottom_m = 0.05, .top_m = 1.05};
  const double area = pi * what.radius_m * what.radius_m, ground = what.size_m.prod();
  const auto discs = static_cast<double>(random_discs(what).size());
  for (const double sza : {0.0, 30.0, 60.0}) {
    const double g = g_function(what.angles, radians(sza)), mu = std::cos(radians(sza));
    const double below = std::pow(1 - g * area / (ground * mu), discs);
    EXPECT_NEAR(below, std::exp(-g * what.lai / mu), 1e-3);
    expect_agree(transmittance(sza, 0.01, what), {below, 0}, 0.02, fmt::format("below, sun at {}", sza));
    // Half of the area is above the middle, also of the discs that cross it, in the mean of their tilts.
    expect_agree(transmittance(sza, 0.55, what), {std::sqrt(below), 0}, 0.02,
                 fmt::format("middle, sun at {}", sza));
  }
}

// The sky's light under black leaves: the mean of the direct transmittance over the cosine-weighted
// hemisphere, 2 E3(G LAI) for spherical leaves (G = 0.5).
TEST(Levels, DiffuseTransmittanceIsTheMeanOfTheDirect) {
  constexpr int canopies = 12;
  constexpr double lai = 1.5;
  std::vector<double> draws;
  for (std::uint64_t seed = 1; seed <= canopies; ++seed) {
    const TemporaryFolder folder;
    SceneText scene = canopy_text(
        folder,
        {.lai = lai, .radius_m = 0.02, .size_m = {2, 2}, .bottom_m = 0.05, .top_m = 1.05, .seed = seed});
    scene.leaf = bilambertian("0", "0");
    scene.sky = white_sky;
    scene.sensor = looking_up(0.01);
    scene.sampling = "samples = 32768";
    draws.push_back(estimate_of(run_of(folder, scene, "", seed)).value);
  }
  double expected = 0;
  constexpr int steps = 100000;
  for (int i = 0; i < steps; ++i) expected += std::exp(-0.5 * lai / std::sqrt((i + 0.5) / steps)) / steps;
  expect_agree(mean_of(draws), {expected, 0}, 0.02, "under the sky");
}

// Over a plane of reflectance r the light that looks up from below a sheet of leaves: a black sheet takes
// all; a clear one gives the sun's own irradiance, cosine and all.
TEST(Levels, OpenSkyGivesAllLight) {
  const TemporaryFolder folder;
  SceneText scene{.soil = lambertian("0.4"),
                  .sun = sun_at(60, 120),
                  .sensor = looking_up(0.5),
                  .sampling = "samples = 4096"};
  expect_agree(estimate_of(run_of(folder, scene)), {1, 0}, 0.001, "sun");
  scene.sun.clear();
  scene.sky = white_sky;
  expect_agree(estimate_of(run_of(folder, scene)), {1, 0}, 0.001, "sky");
}

}  // namespace
}  // namespace bpms::test
