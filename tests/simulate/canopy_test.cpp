// Random disc canopies: energy, gap probabilities, the hot spot.
#include <gmock/gmock.h>

#include <cmath>

#include "core/units.h"
#include "tests/simulate/scene_text.h"
#include "tests/simulate/spread.h"

namespace bpms::test {
namespace {

// LAI 2 of discs that stand free of the ground.
SceneText dense_canopy(const TemporaryFolder& folder) {
  return canopy_text(folder, {.lai = 2, .size_m = {4, 4}, .bottom_m = 0.05});
}

TEST(Canopy, WhiteFurnaceIsWhiteOnEveryPath) {
  const TemporaryFolder folder;
  SceneText scene = dense_canopy(folder);
  scene.leaf = bilambertian("0.7", "0.3");
  scene.soil = lambertian("1.0");
  scene.sky = white_sky;
  scene.sensor = views("[[0, 0], [45, 30], [75, 200]]");
  scene.sampling = "samples = 2048\nroulette = false";
  const SensorResult result = sensor_result(folder, scene);
  for (std::size_t view = 0; view < 3; ++view) {
    EXPECT_NEAR(result.radiance[0].value[view], 1.0, 1e-6);
    EXPECT_LT(result.radiance[0].standard_error[view], 1e-6);
  }
}

TEST(Canopy, RouletteLeavesTheMeanAlone) {
  const TemporaryFolder folder;
  SceneText scene = dense_canopy(folder);
  scene.leaf = bilambertian("0.5", "0.44");
  scene.sun = sun_at(30, 10);
  scene.sky = white_sky;
  scene.sensor = views("[[0, 0], [45, 30]]");
  scene.sampling = "samples = 32768\n";
  const SensorResult with = sensor_result(folder, scene, 1);
  scene.sampling += "roulette = false";
  const SensorResult without = sensor_result(folder, scene, 2);
  for (const Origin origin : {Origin::direct, Origin::diffuse})
    for (std::size_t view = 0; view < 2; ++view)
      EXPECT_LT(std::abs(z_of(part_of(with, origin), view, part_of(without, origin), view)), 4)
          << name_of(origin) << " view " << view;
}

// Poisson canopy of small discs: P(v) = exp(-G LAI / mu), and far from the hot spot the sunlit ground seen is
// exp(-(G / mu_s + G / mu_v) LAI). One canopy is one draw: the error is that between eight of them.
TEST(Canopy, GapAndSunlitGroundFollowTheExponentialLaw) {
  constexpr int draws = 8;
  constexpr double lai = 1.0, sza = 30.0, vza = 50.0, g = 0.5;
  std::vector<double> gap, lit;
  for (int draw = 0; draw < draws; ++draw) {
    const TemporaryFolder folder;
    SceneText text = canopy_text(folder, {.lai = lai,
                                          .radius_m = 0.02,
                                          .size_m = {3, 3},
                                          .bottom_m = 0.05,
                                          .seed = static_cast<std::uint64_t>(draw + 1)});
    text.sun = sun_at(sza, 100);
    text.sensor = principal_plane(fmt::format("[{}]", vza));
    text.sampling = "samples = 32768\nmax_order = 1";
    const Simulation scene = simulation_of(folder, text);
    const SensorResult result = simulate(scene, 1).sensors.at(0);
    gap.push_back(result.gap.value[0]);
    const std::size_t soil = scene.materials[0].name == "soil" ? 0 : 1;
    lit.push_back(result.sunlit.value[soil]);
  }
  const auto expect = [](const std::vector<double>& values, double expected, const char* what) {
    const Mean found = mean_of(values);
    EXPECT_LT(found.error, 0.02 * expected) << what;
    EXPECT_LT(std::abs(found.value - expected), 4.5 * found.error)
        << what << " " << found.value << " +- " << found.error << ", expected " << expected;
  };
  expect(gap, std::exp(-g * lai / std::cos(radians(vza))), "gap");
  expect(lit, std::exp(-g * lai * (1 / std::cos(radians(sza)) + 1 / std::cos(radians(vza)))),
         "sunlit ground");
}

// In the principal plane the hot spot lies on the sun's side: at vza = -sza all that is seen is lit.
TEST(Canopy, HotSpotLiesAtMinusTheSunZenith) {
  const TemporaryFolder folder;
  SceneText scene = dense_canopy(folder);
  scene.sun = sun_at(35, 240);
  scene.sensor = principal_plane("[-35, 35]");
  scene.sampling = "samples = 4096\nmax_order = 1";
  const SensorResult result = sensor_result(folder, scene);
  EXPECT_NEAR(result.shaded.value[0] + result.shaded.value[1], 0.0, 1e-3);
  EXPECT_GT(result.shaded.value[2] + result.shaded.value[3], 0.1);
  for (std::size_t view = 0; view < 2; ++view) {
    const double all = result.sunlit.value[2 * view] + result.sunlit.value[2 * view + 1] +
                       result.shaded.value[2 * view] + result.shaded.value[2 * view + 1];
    EXPECT_NEAR(all, 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace bpms::test
