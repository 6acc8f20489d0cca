// Suns and skies against each other.
#include "tests/physics/physics.h"

namespace bpms::test {
namespace {

// What a view gathers from an isotropic sky is what the albedo camera gathers of a sun in the view's place.
TEST(SkyAndSun, ViewUnderAnIsotropicSkyIsTheDhrOfTheAlbedoCamera) {
  const TemporaryFolder folder;
  SceneText scene = mixed_canopy(folder);
  scene.leaf = bilambertian("0.6", "0.2") + "reflectance_back = 0.2";
  scene.soil = lambertian("0.4");
  for (const auto& [zenith, azimuth] : {std::pair{15.0, 40.0}, {50.0, 75.0}, {70.0, 250.0}}) {
    scene.sky.clear();
    scene.sun = sun_at(zenith, azimuth);
    scene.sensor = albedo_down;
    scene.sampling = "samples = 262144";
    const Mean dhr = estimate_of(run_of(folder, scene, "", 1));
    scene.sun.clear();
    scene.sky = white_sky;
    scene.sensor = views(fmt::format("[[{}, {}]]", zenith, azimuth));
    scene.sampling = "samples = 131072";
    const Mean hdrf = estimate_of(run_of(folder, scene, "", 2));
    expect_agree(dhr, hdrf, 0.004, fmt::format("zenith {}", zenith));
  }
}

// The same of a canopy as high as its cell is wide, whose shadows reach over several periods: a sun is asked
// through the grid of its parallel rays, the sky never.
TEST(SkyAndSun, ShadowsReachOverSeveralPeriods) {
  const TemporaryFolder folder;
  SceneText scene =
      canopy_text(folder, {.lai = 3, .radius_m = 0.05, .size_m = {1.5, 1.5}, .bottom_m = 0.1, .top_m = 2.5});
  scene.leaf = bilambertian("0.2", "0.2");
  for (const double zenith : {50.0, 70.0}) {
    scene.sky.clear();
    scene.sun = sun_at(zenith, 0);
    scene.sensor = albedo_down;
    scene.sampling = "samples = 65536";
    const Mean dhr = estimate_of(run_of(folder, scene, "", 1));
    scene.sun.clear();
    scene.sky = white_sky;
    scene.sensor = views(fmt::format("[[{}, 0]]", zenith));
    scene.sampling = "samples = 131072";
    expect_agree(dhr, estimate_of(run_of(folder, scene, "", 2)), 0.02, fmt::format("zenith {}", zenith));
  }
}

// A sky brighter towards one side, in steps of a grid; `name`.csv.
std::string uneven_map(const TemporaryFolder& folder) {
  std::string rows = "zenith_deg,azimuth_deg,radiance\n";
  for (int zenith = 0; zenith <= 90; zenith += 5)
    for (int azimuth = 0; azimuth < 360; azimuth += 15)
      rows += fmt::format("{},{},{}\n", zenith, azimuth,
                          1 + std::sin(radians(zenith)) * (0.8 * std::cos(radians(azimuth - 100.0)) + 0.5));
  folder.write("uneven.csv", rows);
  return "type = \"map\", file = \"uneven.csv\"";
}

// HDRF = (1 - f) BRF of the sun + f HDRF of the sky, f the part of the sky in the irradiance.
TEST(SkyAndSun, DiffuseFractionRecombinesRunsOfEach) {
  const TemporaryFolder folder;
  SceneText scene = mixed_canopy(folder);
  scene.sensor = views("[[0, 0], [40, 100], [60, 280]]");
  scene.sampling = "samples = 65536";
  const std::string map = uneven_map(folder);
  scene.sun = sun_at(50, 100);
  const SensorResult of_sun = run_of(folder, scene, "", 1);
  scene.sun.clear();
  scene.sky = "{ " + map + ", irradiance = \"brf\" }";
  const SensorResult of_sky = run_of(folder, scene, "", 2);
  for (const double f : {0.15, 0.6}) {
    scene.sun = sun_at(50, 100, fmt::format("{}", (1 - f) * pi / std::cos(radians(50))));
    scene.sky = fmt::format("{{ {}, irradiance = {} }}", map, f * pi);
    const SensorResult both = run_of(folder, scene, "", 3);
    for (std::size_t view = 0; view < 3; ++view) {
      const Mean a = estimate_of(of_sun, view), b = estimate_of(of_sky, view);
      expect_agree(estimate_of(both, view),
                   {(1 - f) * a.value + f * b.value, std::hypot((1 - f) * a.error, f * b.error)}, 0.005,
                   fmt::format("f {}, view {}", f, view));
    }
  }
}

// A map that is bright within a cap about the zenith and falls to 0 over 0.25 degrees, and a sun's disc with
// its edge half way down: the light is the same but for some (0.125 / 5)^2 of its spread.
TEST(SkyAndSun, ABrightCapOfTheSkyIsADiscOfTheSun) {
  const TemporaryFolder folder;
  std::string rows = "zenith_deg,azimuth_deg,radiance\n";
  for (int i = 0; i <= 360; ++i) rows += fmt::format("{},0,{}\n", 0.25 * i, i <= 20 ? 1 : 0);
  folder.write("cap.csv", rows);
  SceneText scene = mixed_canopy(folder);
  scene.sensor = views("[[10, 0], [40, 100], [60, 280]]");
  scene.sampling = "samples = 65536";
  scene.sky = "{ type = \"map\", file = \"cap.csv\", irradiance = \"brf\" }";
  const SensorResult sky = run_of(folder, scene, "", 1);
  scene.sky.clear();
  scene.sun = "{ zenith_deg = 0, azimuth_deg = 0, radius_deg = 5.125, irradiance = \"brf\" }";
  const SensorResult sun = run_of(folder, scene, "", 2);
  for (std::size_t view = 0; view < 3; ++view)
    expect_agree(estimate_of(sky, view), estimate_of(sun, view), 0.005, fmt::format("view {}", view));
}

// One bright point of the grid, a pyramid of 1 degree to all sides, and a sun there: azimuths and zeniths are
// those of the sun. What curvature of the BRF makes of that width is some 1e-4.
TEST(SkyAndSun, ABrightPointOfTheSkyIsASun) {
  const TemporaryFolder folder;
  std::string rows = "zenith_deg,azimuth_deg,radiance\n";
  for (int zenith = 0; zenith <= 90; ++zenith)
    for (int azimuth = 0; azimuth < 360; ++azimuth)
      rows += fmt::format("{},{},{}\n", zenith, azimuth, zenith == 55 && azimuth == 130 ? 1 : 0);
  folder.write("point.csv", rows);
  SceneText scene = mixed_canopy(folder);
  scene.sensor = views("[[0, 0], [40, 130], [40, 310], [60, 220]]");
  scene.sampling = "samples = 262144";
  scene.sky = "{ type = \"map\", file = \"point.csv\", irradiance = \"brf\" }";
  const SensorResult sky = run_of(folder, scene, "", 1);
  scene.sky.clear();
  scene.sun = sun_at(55, 130);
  const SensorResult sun = run_of(folder, scene, "", 2);
  for (std::size_t view = 0; view < 4; ++view)
    expect_agree(estimate_of(sky, view), estimate_of(sun, view), 0.005, fmt::format("view {}", view));
}

}  // namespace
}  // namespace bpms::test
