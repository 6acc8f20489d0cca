// Random disc canopies: energy, gap probabilities, the hot spot.
#include <gmock/gmock.h>

#include <cmath>

#include "core/units.h"
#include "tests/simulate/random_canopy.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

std::string canopy_scene(const TemporaryFolder& folder, const RandomCanopy& canopy, double reflectance,
                         double transmittance, double soil) {
  folder.write("canopy.def", disc_list(canopy));
  return fmt::format(R"(
[domain]
size_m = [{0}, {0}]
[materials.leaf]
type = "bilambertian"
reflectance = {1}
transmittance = {2}
[materials.soil]
type = "lambertian"
reflectance = {3}
[ground]
type = "plane"
material = "soil"
[prototypes.canopy]
discs = "canopy.def"
material = "leaf"
[[instances]]
prototype = "canopy"
positions = [[0.0, 0.0, 0.0]]
)",
                     canopy.side_m, reflectance, transmittance, soil);
}

TEST(Canopy, WhiteFurnaceIsWhiteOnEveryPath) {
  const TemporaryFolder folder;
  const Simulation scene = simulation_of(folder, canopy_scene(folder, {4, 2, 0.05, 2, 1}, 0.7, 0.3, 1.0) + R"(
[illumination]
sky = { type = "isotropic", radiance = 1.0 }
[[sensors]]
name = "views"
type = "brf"
views = [[0.0, 0.0], [45.0, 30.0], [75.0, 200.0]]
[sampling]
samples = 2048
roulette = false
)");
  const SensorResult result = simulate(scene, 1).sensors.at(0);
  for (std::size_t view = 0; view < 3; ++view) {
    EXPECT_NEAR(result.radiance[0].value[view], 1.0, 1e-6);
    EXPECT_LT(result.radiance[0].standard_error[view], 1e-6);
  }
}

TEST(Canopy, RouletteLeavesTheMeanAlone) {
  const TemporaryFolder folder;
  const std::string text = canopy_scene(folder, {4, 2, 0.05, 2, 1}, 0.5, 0.44, 0.2) + R"(
[illumination]
sun = { zenith_deg = 30.0, azimuth_deg = 10.0, irradiance = "brf" }
sky = { type = "isotropic", irradiance = "brf" }
[[sensors]]
name = "views"
type = "brf"
views = [[0.0, 0.0], [45.0, 30.0]]
[sampling]
samples = 32768
)";
  const SensorResult with = simulate(simulation_of(folder, text), 1).sensors.at(0);
  const SensorResult without = simulate(simulation_of(folder, text + "roulette = false\n"), 2).sensors.at(0);
  for (const Origin origin : {Origin::direct, Origin::diffuse}) {
    for (std::size_t view = 0; view < 2; ++view) {
      const Estimates &a = part_of(with, origin), &b = part_of(without, origin);
      const double z =
          (a.value[view] - b.value[view]) / std::hypot(a.standard_error[view], b.standard_error[view]);
      EXPECT_LT(std::abs(z), 4) << name_of(origin) << " " << a.value[view] << " " << b.value[view];
    }
  }
}

// Poisson canopy of small discs: P(v) = exp(-G LAI / mu), and far from the hot spot the sunlit ground seen is
// exp(-(G / mu_s + G / mu_v) LAI). One canopy is one draw: the error is that between eight of them.
TEST(Canopy, GapAndSunlitGroundFollowTheExponentialLaw) {
  constexpr int draws = 8;
  constexpr double lai = 1.0, sza = 30.0, vza = 50.0, g = 0.5;
  double gap[draws], lit[draws];
  for (int draw = 0; draw < draws; ++draw) {
    const TemporaryFolder folder;
    const RandomCanopy canopy{3, 2, 0.02, lai, static_cast<std::uint64_t>(draw + 1)};
    const Simulation scene =
        simulation_of(folder, canopy_scene(folder, canopy, 0.1, 0.1, 0.2) + fmt::format(R"(
[illumination]
sun = {{ zenith_deg = {}, azimuth_deg = 100.0, irradiance = "brf" }}
[[sensors]]
name = "pp"
type = "brf"
plane = "principal"
vza_deg = [{}]
[sampling]
samples = 32768
max_order = 1
)",
                                                                                        sza, vza));
    const SensorResult result = simulate(scene, 1).sensors.at(0);
    gap[draw] = result.gap.value[0];
    const std::size_t soil = scene.materials[0].name == "soil" ? 0 : 1;
    lit[draw] = result.sunlit.value[soil];
  }
  const auto expect = [&](const double* values, double expected, const char* what) {
    double mean = 0, squares = 0;
    for (int i = 0; i < draws; ++i) mean += values[i] / draws;
    for (int i = 0; i < draws; ++i) squares += (values[i] - mean) * (values[i] - mean);
    const double error = std::sqrt(squares / (draws * (draws - 1)));
    EXPECT_LT(error, 0.02 * expected) << what;
    EXPECT_LT(std::abs(mean - expected), 4.5 * error)
        << what << " " << mean << " +- " << error << ", expected " << expected;
  };
  expect(gap, std::exp(-g * lai / std::cos(radians(vza))), "gap");
  expect(lit, std::exp(-g * lai * (1 / std::cos(radians(sza)) + 1 / std::cos(radians(vza)))),
         "sunlit ground");
}

// In the principal plane the hot spot lies on the sun's side: at vza = -sza all that is seen is lit.
TEST(Canopy, HotSpotLiesAtMinusTheSunZenith) {
  const TemporaryFolder folder;
  const Simulation scene = simulation_of(folder, canopy_scene(folder, {4, 2, 0.05, 2, 1}, 0.5, 0.4, 0.2) + R"(
[illumination]
sun = { zenith_deg = 35.0, azimuth_deg = 240.0, irradiance = "brf" }
[[sensors]]
name = "pp"
type = "brf"
plane = "principal"
vza_deg = [-35.0, 35.0]
[sampling]
samples = 4096
max_order = 1
)");
  const SensorResult result = simulate(scene, 1).sensors.at(0);
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
