// Sheets over a plane, and mirrors, in closed form.
#include "tests/physics/physics.h"

namespace bpms::test {
namespace {

// The sun comes through with tau, and so does the view: tau^2 rho. Nothing is thrown back and forth.
TEST(Sheets, TransparentOverAPlane) {
  const TemporaryFolder folder;
  folder.write("sheet.obj", sheet_obj(0.5));
  SceneText scene{.leaf = "type = \"transparent\"\ntransmittance = 0.7",
                  .soil = lambertian("0.3"),
                  .mesh = "sheet.obj",
                  .sensor = views("[[0, 0], [45, 30], [70, 200]]"),
                  .sampling = "samples = 1024\nroulette = false"};
  for (const bool sun : {true, false}) {
    scene.sun = sun ? sun_at(40, 120) : "";
    scene.sky = sun ? "" : white_sky;
    const SensorResult result = run_of(folder, scene);
    for (std::size_t view = 0; view < 3; ++view) {
      const Mean found = estimate_of(result, view);
      EXPECT_NEAR(found.value, 0.7 * 0.7 * 0.3, 1e-6) << (sun ? "sun, view " : "sky, view ") << view;
      EXPECT_LT(found.error, 1e-6);
    }
  }
}

// Two of them: tau^4 rho; and one at which the light of the ground is thrown back: with a sheet that reflects
// r and transmits t straight, order by order r g r g ..: L = t^2 g / (1 - r g) + r.
TEST(Sheets, StandardReflectanceMaterialOverAPlane) {
  const TemporaryFolder folder;
  folder.write("sheet.obj", sheet_obj(0.5));
  SceneText scene{.leaf = "type = \"srm\"\nreflectance = 0.2\nspecular_transmittance = 0.5",
                  .soil = lambertian("0.6"),
                  .mesh = "sheet.obj",
                  .sun = sun_at(40, 120),
                  .sensor = views("[[0, 0], [45, 30], [70, 200]]"),
                  .sampling = "samples = 65536"};
  const SensorResult result = run_of(folder, scene);
  const double expected = 0.2 + 0.5 * 0.5 * 0.6 / (1 - 0.2 * 0.6);
  for (std::size_t view = 0; view < 3; ++view)
    expect_agree(estimate_of(result, view), {expected, 0}, 0.005, fmt::format("view {}", view));
}

// A diffuse transmitter over a plane: the light takes one way, in through the sheet and out again, tau^2 rho.
// ARARAT's shadow rays find the sun through the sheet besides, and count all of it twice.
TEST(Sheets, AttenuatedShadowRaysCountDiffuseTransmissionTwice) {
  const TemporaryFolder folder;
  folder.write("sheet.obj", sheet_obj(0.5));
  SceneText scene{.leaf = bilambertian("0", "0.6"),
                  .soil = lambertian("0.5"),
                  .mesh = "sheet.obj",
                  .sun = sun_at(40, 120),
                  .sensor = views("[[0, 0], [45, 30]]")};
  for (const bool attenuate : {false, true}) {
    scene.sampling = "samples = 16384\nroulette = false";
    if (attenuate) scene.sampling += "\nshadow = \"attenuate\"";
    const SensorResult result = run_of(folder, scene);
    for (std::size_t view = 0; view < 2; ++view)
      expect_agree(estimate_of(result, view), {(attenuate ? 2 : 1) * 0.6 * 0.6 * 0.5, 0}, 0.005,
                   attenuate ? "attenuate" : "block");
  }
}

// A mirror shows the sky where it points, and adds its diffuse part: r_s L(mirrored) + r_d E / pi. Views and
// their mirrored directions are points of the map's grid.
TEST(Mirrors, ShowTheSkyWhereTheyPoint) {
  const TemporaryFolder folder;
  const auto radiance = [](double zenith_deg, double azimuth_deg) {
    return 1 + std::sin(radians(zenith_deg)) * (0.8 * std::cos(radians(azimuth_deg - 100)) + 0.5);
  };
  std::string rows = "zenith_deg,azimuth_deg,radiance\n";
  for (int zenith = 0; zenith <= 90; zenith += 5)
    for (int azimuth = 0; azimuth < 360; azimuth += 15)
      rows += fmt::format("{},{},{}\n", zenith, azimuth, radiance(zenith, azimuth));
  folder.write("sky.csv", rows);
  const SceneText scene{.soil = "type = \"srm\"\nreflectance = 0.1\nspecular_reflectance = 0.6",
                        .sky = "{ type = \"map\", file = \"sky.csv\" }",
                        .sensor = views("[[0, 0], [35, 30], [70, 210], [60, 285]]"),
                        .sampling = "samples = 65536\nroulette = false"};
  const Simulation simulation = simulation_of(folder, scene);
  const double even = simulation.light.diffuse_irradiance(1)[0] / pi;
  const SensorResult result = simulate(simulation, 1).sensors.at(0);
  const double mirrored[4][2] = {{0, 0}, {35, 210}, {70, 30}, {60, 105}};
  for (std::size_t view = 0; view < 4; ++view)
    expect_agree(estimate_of(result, view),
                 {0.6 * radiance(mirrored[view][0], mirrored[view][1]) + 0.1 * even, 0}, 0.005,
                 fmt::format("view {}", view));
}

// And the sun's disc, whose radiance is E / (pi sin^2 radius).
TEST(Mirrors, ShowTheDiscOfTheSun) {
  const TemporaryFolder folder;
  const SceneText scene{.soil = "type = \"srm\"\nspecular_reflectance = 0.6",
                        .sun = "{ zenith_deg = 40, azimuth_deg = 120, irradiance = 3.0, radius_deg = 2.0 }",
                        .sensor = views("[[40, 300], [41.5, 300], [43, 300], [40, 120]]"),
                        .sampling = "samples = 1024\nroulette = false"};
  const SensorResult result = run_of(folder, scene);
  const double disc = 3.0 / (pi * std::pow(std::sin(radians(2.0)), 2));
  const double expected[4] = {0.6 * disc, 0.6 * disc, 0, 0};
  for (std::size_t view = 0; view < 4; ++view)
    EXPECT_NEAR(result.radiance[0].value[view], expected[view], 1e-4 * disc) << "view " << view;
}

}  // namespace
}  // namespace bpms::test
