// Scenes whose radiance is known in closed form.
#include <gmock/gmock.h>

#include <cmath>

#include "core/units.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

const std::string bare_plane = R"(
[domain]
size_m = [2.0, 2.0]
[materials.soil]
type = "lambertian"
reflectance = 0.3
[ground]
type = "plane"
material = "soil"
)";

TEST(ClosedForms, BrfOfABarePlaneIsItsReflectance) {
  const TemporaryFolder folder;
  const Simulation scene = simulation_of(folder, bare_plane + R"(
[illumination]
sun = { zenith_deg = 40.0, azimuth_deg = 120.0, irradiance = "brf" }
[[sensors]]
name = "pp"
type = "brf"
plane = "principal"
vza_deg = { from = -60.0, to = 60.0, step = 30.0 }
[sampling]
samples = 64
)");
  const Result result = simulate(scene, 1);
  const SensorResult& pp = result.sensors.at(0);
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
  const Simulation scene = simulation_of(folder, bare_plane + R"(
[illumination]
sun = { zenith_deg = 60.0, azimuth_deg = 0.0, irradiance = 1000.0 }
sky = { type = "isotropic", irradiance = 200.0 }
[[sensors]]
name = "nadir"
type = "brf"
views = [[0.0, 0.0], [35.0, 77.0]]
[sampling]
samples = 64
roulette = false
)");
  const SensorResult result = simulate(scene, 1).sensors.at(0);
  for (std::size_t view = 0; view < 2; ++view) {
    EXPECT_NEAR(part_of(result, Origin::direct).value[view], 0.3 / pi * 500.0, 1e-4);
    EXPECT_NEAR(part_of(result, Origin::diffuse).value[view], 0.3 / pi * 200.0, 1e-4);
    EXPECT_NEAR(part_of(result, Origin::total).value[view], 0.3 / pi * 700.0, 1e-4);
  }
}

// A plane tilted by 30 degrees towards the east, lit from the east: L = (rho / pi) E cos(angle of incidence).
TEST(ClosedForms, TiltedPlane) {
  const TemporaryFolder folder;
  const double t = std::tan(radians(30));
  folder.write("tilted.obj", fmt::format("v -5 -5 {}\nv 5 -5 {}\nv 5 5 {}\nv -5 5 {}\nf 1 2 3\nf 1 3 4\n",
                                         5 * t, -5 * t, -5 * t, 5 * t));
  const Simulation scene = simulation_of(folder, R"(
[domain]
boundary = "open"
[materials.wall]
type = "lambertian"
reflectance = 0.5
[prototypes.wall]
mesh = "tilted.obj"
material = "wall"
[[instances]]
prototype = "wall"
positions = [[0.0, 0.0, 0.0]]
[illumination]
sun = { zenith_deg = 50.0, azimuth_deg = 90.0, irradiance = 100.0 }
[[sensors]]
name = "camera"
type = "perspective"
location = [0.0, 0.0, 10.0]
direction = [0.0, 0.0, -1.0]
fov_deg = 20.0
width_px = 3
height_px = 2
[sampling]
samples = 32
)");
  const SensorResult result = simulate(scene, 1).sensors.at(0);
  ASSERT_EQ(result.samples.size(), 6u);
  for (const double value : result.radiance[0].value)
    EXPECT_NEAR(value, 0.5 / pi * 100.0 * std::cos(radians(20)), 1e-4);
}

// What meets nothing sees the sky: order 0, kept out of nothing in an image.
TEST(ClosedForms, ACameraSeesTheSky) {
  const TemporaryFolder folder;
  const Simulation scene = simulation_of(folder, bare_plane + R"(
[illumination]
sky = { type = "isotropic", radiance = 7.0 }
[[sensors]]
name = "camera"
type = "perspective"
location = [0.0, 0.0, 3.0]
look_at = [10.0, 0.0, 8.0]
zoom = 3.0
width_px = 4
height_px = 4
[sampling]
samples = 32
)");
  const SensorResult result = simulate(scene, 1).sensors.at(0);
  for (const double value : result.radiance[0].value) EXPECT_NEAR(value, 7.0, 1e-5);
}

}  // namespace
}  // namespace bpms::test
