// Several suns in one run, and suns that are discs.
#include <gmock/gmock.h>

#include <cmath>

#include "core/units.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

const RandomDiscs thin{.lai = 1.5, .radius_m = 0.05, .size_m = {2, 2}, .top_m = 1};

// The paths of a view do not depend on the suns: each sun's part has the very bits of a run with it alone.
TEST(SeveralSuns, EachIsAsInARunOfItsOwn) {
  const TemporaryFolder folder;
  SceneText scene = canopy_text(folder, thin);
  scene.sensor = views("[[0, 0], [40, 90]]");
  scene.sampling = "samples = 2048\nroulette = false\nmax_order = 8";
  const std::string suns[] = {sun_at(20, 0), sun_at(55, 130)};
  scene.sun = "[" + suns[0] + ", " + suns[1] + "]";
  const SensorResult both = sensor_result(folder, scene);
  for (int s = 0; s < 2; ++s) {
    scene.sun = suns[s];
    const SensorResult alone = sensor_result(folder, scene);
    for (const Part& part : {Part{Origin::total}, Part{Origin::total, Component::uc_sgl},
                             Part{Origin::total, Component::mlt}, Part{Origin::total, Component::all, 2}}) {
      Part own = part;
      own.origin = Origin::direct;
      own.sun = s;
      const Estimates& of_both = part_of(both, own);
      const Estimates& of_one = part_of(alone, part);
      for (std::size_t view = 0; view < 2; ++view) {
        EXPECT_NEAR(of_both.value[view], of_one.value[view], 1e-9);
        EXPECT_NEAR(of_both.standard_error[view], of_one.standard_error[view], 1e-9);
      }
    }
    for (std::size_t view = 0; view < 2; ++view) {
      EXPECT_EQ(both.sunlit_ground.value[view * 2 + static_cast<std::size_t>(s)],
                alone.sunlit_ground.value[view]);
      for (std::size_t m = 0; m < 2; ++m)
        EXPECT_EQ(both.sunlit.value[(view * 2 + static_cast<std::size_t>(s)) * 2 + m],
                  alone.sunlit.value[view * 2 + m]);
    }
  }
  const Estimates& total = both.radiance[0];
  for (std::size_t view = 0; view < 2; ++view)
    EXPECT_NEAR(total.value[view],
                part_of(both, Part{Origin::direct, Component::all, every_order, 0}).value[view] +
                    part_of(both, Part{Origin::direct, Component::all, every_order, 1}).value[view],
                1e-9);
}

// A disc of even radiance above the horizon gives a horizontal plane E cos(zenith of its centre), exactly:
// each of its points counts by its cosine, which averages to the centre's (times the same factor as on the
// normal plane).
TEST(SunDisc, LightsAPlaneAsItsCentreDoes) {
  const TemporaryFolder folder;
  for (const double radius_deg : {0.2666, 10.0}) {
    SceneText scene{.soil = lambertian("0.4"), .sampling = "samples = 65536"};
    scene.sensor = views("[[30, 0]]");
    scene.sun = sun_at(50, 0, "1000.0");
    Simulation simulation = simulation_of(folder, scene);
    simulation.light.suns[0].radius = radians(radius_deg);
    const SensorResult result = simulate(simulation, 3).sensors[0];
    const double expected = 0.4 / pi * 1000 * std::cos(radians(50.0));
    EXPECT_GT(result.radiance[0].standard_error[0], 0);
    EXPECT_LT(std::abs(result.radiance[0].value[0] - expected), 4 * result.radiance[0].standard_error[0]);
  }
}

// The half-shadow of a straight edge: a screen that covers half of the sun's disc takes half of its light.
TEST(SunDisc, IsHalfCoveredByAnEdge) {
  const TemporaryFolder folder;
  // A wide disc 1 m above the plane; the point below its edge sees half of a sun at the zenith.
  folder.write("screen.def", "1000 1000 0 1 0 0 1\n");
  SceneText scene{.domain = "boundary = \"open\"",
                  .leaf = lambertian("0"),
                  .soil = lambertian("0.5"),
                  .discs = "screen.def",
                  .sampling = "samples = 65536"};
  scene.sensor = camera("[-0.0, 0, 0.5]", "direction = [0, 0, -1]\nfov_deg = 0.001\nup = [0, 1, 0]", 1, 1);
  scene.sun = sun_at(0, 0, "1.0");
  Simulation simulation = simulation_of(folder, scene);
  simulation.light.suns[0].radius = radians(2.0);
  simulation.sampling.max_order = 1;
  const SensorResult result = simulate(simulation, 1).sensors[0];
  const double whole = 0.5 / pi;
  EXPECT_LT(std::abs(result.radiance[0].value[0] - 0.5 * whole), 4 * result.radiance[0].standard_error[0]);
  EXPECT_LT(result.radiance[0].standard_error[0], 0.01 * whole);
}

// A camera that looks at the disc sees its radiance, E / (pi sin^2 radius).
TEST(SunDisc, IsSeenByACamera) {
  const TemporaryFolder folder;
  SceneText scene{.soil = lambertian("0"), .sampling = "samples = 64"};
  scene.sensor = camera("[0, 0, 1]", "direction = [0, 0, 1]\nfov_deg = 0.1\nup = [0, 1, 0]", 1, 1);
  scene.sun = sun_at(0, 0, "7.0");
  Simulation simulation = simulation_of(folder, scene);
  simulation.light.suns[0].radius = radians(1.0);
  const SensorResult result = simulate(simulation, 1).sensors[0];
  EXPECT_NEAR(result.radiance[0].value[0], 7 / (pi * std::pow(std::sin(radians(1.0)), 2)), 1e-3);
}

// Splitting the path at its first interaction changes no mean.
TEST(DiffuseRays, SeveralFromTheFirstInteractionAgreeWithOne) {
  const TemporaryFolder folder;
  SceneText scene = canopy_text(folder, thin);
  scene.sensor = views("[[0, 0]]");
  scene.sun = sun_at(30, 0);
  scene.sky = white_sky;
  scene.sampling = "samples = 32768";
  const SensorResult one = sensor_result(folder, scene);
  scene.sampling = "samples = 32768\ndiffuse_rays = 6";
  const SensorResult six = sensor_result(folder, scene, 2);
  for (const Component component : {Component::uc_sgl, Component::mlt})
    EXPECT_LT(std::abs(z_of(part_of(one, Origin::direct, component), 0,
                            part_of(six, Origin::direct, component), 0)),
              4);
  EXPECT_LT(std::abs(z_of(part_of(one, Origin::diffuse), 0, part_of(six, Origin::diffuse), 0)), 4);
  // It pays in variance per path: six ways on from each first hit.
  EXPECT_LT(part_of(six, Origin::direct, Component::mlt).standard_error[0],
            part_of(one, Origin::direct, Component::mlt).standard_error[0]);
}

}  // namespace
}  // namespace bpms::test
