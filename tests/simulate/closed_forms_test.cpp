// Scenes whose radiance is known in closed form.
#include <gmock/gmock.h>

#include <cmath>

#include "core/units.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

SceneText bare_plane(const std::string& sampling = "samples = 64") {
  return {.soil = lambertian("0.3"), .sampling = sampling};
}

TEST(ClosedForms, BrfOfABarePlaneIsItsReflectance) {
  const TemporaryFolder folder;
  SceneText scene = bare_plane();
  scene.sun = sun_at(40, 120);
  scene.sensor = principal_plane("{ from = -60, to = 60, step = 30 }");
  const SensorResult pp = sensor_result(folder, scene);
  ASSERT_EQ(pp.samples.size(), 5u);
  for (std::size_t view = 0; view < 5; ++view) {
    EXPECT_NEAR(pp.radiance[0].value[view], 0.3, 1e-6);
    EXPECT_NEAR(pp.radiance[0].standard_error[view], 0.0, 1e-7);
    EXPECT_NEAR(part_of(pp, Origin::total, Component::uc_sgl).value[view], 0.3, 1e-6);
    EXPECT_EQ(part_of(pp, Origin::total, Component::co_sgl).value[view], 0.0);
    EXPECT_EQ(part_of(pp, Origin::total, Component::mlt).value[view], 0.0);
    EXPECT_EQ(pp.gap.value[view], 1.0);
    EXPECT_EQ(pp.sunlit.value[view], 1.0);
  }
}

// L = (rho / pi) (E_n cos(sun) + pi L_sky), its two parts told apart.
TEST(ClosedForms, SunAndSkyAddUpOnABarePlane) {
  const TemporaryFolder folder;
  SceneText scene = bare_plane("samples = 64\nroulette = false");
  scene.sun = sun_at(60, 0, "1000.0");
  scene.sky = "{ type = \"isotropic\", irradiance = 200.0 }";
  scene.sensor = views("[[0, 0], [35, 77]]");
  const SensorResult result = sensor_result(folder, scene);
  for (std::size_t view = 0; view < 2; ++view) {
    EXPECT_NEAR(part_of(result, Origin::direct).value[view], 0.3 / pi * 500.0, 1e-4);
    EXPECT_NEAR(part_of(result, Origin::diffuse).value[view], 0.3 / pi * 200.0, 1e-4);
    EXPECT_NEAR(part_of(result, Origin::total).value[view], 0.3 / pi * 700.0, 1e-4);
  }
}

// The sky's light of the last order is gathered by a ray that goes on after it.
TEST(ClosedForms, MaxOrderKeepsTheSkyOfItsLastOrder) {
  const TemporaryFolder folder;
  for (const int most : {1, 2}) {
    SceneText scene = bare_plane(fmt::format("samples = 64\nmax_order = {}\nroulette = false", most));
    scene.sun = sun_at(60, 0, "1000.0");
    scene.sky = "{ type = \"isotropic\", irradiance = 200.0 }";
    scene.sensor = views("[[0, 0]]");
    const SensorResult result = sensor_result(folder, scene);
    EXPECT_NEAR(part_of(result, Origin::direct).value[0], 0.3 / pi * 500.0, 1e-4);
    EXPECT_NEAR(part_of(result, Origin::diffuse).value[0], 0.3 / pi * 200.0, 1e-4);
  }
}

// A plane tilted by 30 degrees towards the east, lit from the east: L = (rho / pi) E cos(angle of incidence).
TEST(ClosedForms, TiltedPlane) {
  const TemporaryFolder folder;
  const double t = std::tan(radians(30));
  folder.write("tilted.obj", fmt::format("v -5 -5 {}\nv 5 -5 {}\nv 5 5 {}\nv -5 5 {}\nf 1 2 3\nf 1 3 4\n",
                                         5 * t, -5 * t, -5 * t, 5 * t));
  const SceneText scene{.domain = "boundary = \"open\"",
                        .leaf = lambertian("0.5"),
                        .mesh = "tilted.obj",
                        .sun = sun_at(50, 90, "100.0"),
                        .sensor = camera("[0, 0, 10]", "direction = [0, 0, -1]\nfov_deg = 20", 3, 2),
                        .sampling = "samples = 32"};
  const SensorResult result = sensor_result(folder, scene);
  ASSERT_EQ(result.samples.size(), 6u);
  for (const double value : result.radiance[0].value)
    EXPECT_NEAR(value, 0.5 / pi * 100.0 * std::cos(radians(20)), 1e-4);
}

// What meets nothing sees the sky: order 0, kept out of nothing in an image.
TEST(ClosedForms, ACameraSeesTheSky) {
  const TemporaryFolder folder;
  SceneText scene = bare_plane("samples = 32");
  scene.sky = "{ type = \"isotropic\", radiance = 7.0 }";
  scene.sensor = camera("[0, 0, 3]", "look_at = [10, 0, 8]\nzoom = 3", 4, 4);
  const SensorResult result = sensor_result(folder, scene);
  for (const double value : result.radiance[0].value) EXPECT_NEAR(value, 7.0, 1e-5);
}

}  // namespace
}  // namespace bpms::test
