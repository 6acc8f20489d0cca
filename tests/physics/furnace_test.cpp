// Nothing absorbs: what leaves is what comes, whatever gathers it.
#include "tests/physics/physics.h"

namespace bpms::test {
namespace {

// A map of the radiance 1 everywhere.
std::string even_map(const TemporaryFolder& folder) {
  std::string rows = "zenith_deg,azimuth_deg,radiance\n";
  for (int zenith = 0; zenith <= 90; zenith += 10)
    for (int azimuth = 0; azimuth < 360; azimuth += 30) rows += fmt::format("{},{},1\n", zenith, azimuth);
  folder.write("even.csv", rows);
  return "{ type = \"map\", file = \"even.csv\" }";
}

SceneText furnace(const TemporaryFolder& folder) {
  SceneText scene = mixed_canopy(folder);
  scene.leaf = bilambertian("0.6", "0.4");
  scene.soil = lambertian("1");
  return scene;
}

// Directions drawn from the map and directions that escape share the work: the mean is 1.
TEST(Furnace, UnderASkyMapIsWhite) {
  const TemporaryFolder folder;
  SceneText scene = furnace(folder);
  scene.sky = even_map(folder);
  scene.sensor = views("[[0, 0], [45, 30], [70, 200]]");
  scene.sampling = "samples = 65536\nroulette = false";
  const SensorResult result = run_of(folder, scene);
  for (std::size_t view = 0; view < 3; ++view)
    expect_agree(estimate_of(result, view), {1, 0}, 0.01, fmt::format("view {}", view));
}

// One set of paths for bands that part light between reflection and transmission each in its own way.
TEST(Furnace, OfABundleOfBandsIsWhite) {
  const TemporaryFolder folder;
  for (const int bands : {6, 12}) {  // carried as weights, and counted
    SceneText scene = furnace(folder);
    std::string rho, tau;
    scene.wavelengths_nm = "[";
    for (int band = 0; band < bands; ++band) {
      const int nm = 500 + 10 * band;
      const double share = 0.35 + 0.3 * band / bands;
      rho += fmt::format("[{}, {}], ", nm, share), tau += fmt::format("[{}, {}], ", nm, 1 - share);
      scene.wavelengths_nm += fmt::format("{}, ", nm);
    }
    scene.wavelengths_nm += "]";
    scene.leaf = bilambertian("[" + rho + "]", "[" + tau + "]");
    scene.sky = white_sky;
    scene.sensor = views("[[0, 0], [45, 30]]");
    scene.sampling = "samples = 65536\nroulette = false";
    const SensorResult result = run_of(folder, scene);
    ASSERT_EQ(result.radiance[0].value.size(), 2u * static_cast<std::size_t>(bands));
    for (std::size_t at = 0; at < result.radiance[0].value.size(); ++at)
      expect_agree(estimate_of(result, at), {1, 0}, 0.02, fmt::format("{} bands, value {}", bands, at));
  }
}

// The purist canopy: rho = tau = 0.5, ground 1. Its DHR and BHR are 1.
TEST(Furnace, PuristCanopyGivesBackAllLight) {
  const TemporaryFolder folder;
  SceneText scene = mixed_canopy(folder);
  scene.leaf = bilambertian("0.5", "0.5");
  scene.soil = lambertian("1");
  scene.sensor = albedo_down;
  scene.sampling = "samples = 131072\nroulette = false";
  for (const double sza : {0.0, 30.0, 60.0}) {
    scene.sun = sun_at(sza, 70);
    expect_agree(estimate_of(run_of(folder, scene)), {1, 0}, 0.005, fmt::format("DHR at {}", sza));
  }
  scene.sun.clear();
  scene.sky = white_sky;
  expect_agree(estimate_of(run_of(folder, scene)), {1, 0}, 0.005, "BHR, isotropic sky");
  scene.sky = even_map(folder);
  expect_agree(estimate_of(run_of(folder, scene)), {1, 0}, 0.005, "BHR, sky map");
}

// The same light, by the escaping ray alone and by both ways.
TEST(SkyMapSampling, OfAnEvenMapIsTheIsotropicSky) {
  const TemporaryFolder folder;
  SceneText scene = mixed_canopy(folder);
  scene.sensor = views("[[0, 0], [45, 30], [70, 200]]");
  scene.sampling = "samples = 131072";
  scene.sky = white_sky;
  const SensorResult isotropic = run_of(folder, scene, "", 1);
  scene.sky = even_map(folder);
  const SensorResult map = run_of(folder, scene, "", 2);
  for (std::size_t view = 0; view < 3; ++view)
    expect_agree(estimate_of(map, view), estimate_of(isotropic, view), 0.005, fmt::format("view {}", view));
}

}  // namespace
}  // namespace bpms::test
