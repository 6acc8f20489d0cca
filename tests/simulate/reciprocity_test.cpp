// Light takes every way in both directions: sun and view change places, and what a view gathers from an
// isotropic sky is what the hemisphere gets from a sun in the view's place.
#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "core/random.h"
#include "tests/simulate/hemisphere.h"

namespace bpms::test {
namespace {

// Leaves with two faces, of any tilt: discs, or triangles in their place.
SceneText two_faced_canopy(const TemporaryFolder& folder, bool triangles) {
  const RandomDiscs what{.lai = 2, .radius_m = 0.1, .size_m = {2, 2}, .bottom_m = 0.1, .top_m = 0.8};
  SceneText scene = canopy_text(folder, what);
  scene.leaf = bilambertian("0.6", "0.2") + "reflectance_back = 0.2";
  scene.soil = lambertian("0.4");
  if (!triangles) return scene;
  std::string vertices, faces;
  Philox random(3, 1);
  int count = 0;
  for (const Disc& disc : random_discs(what)) {
    const Eigen::Vector3f side = disc.normal.unitOrthogonal(), other = disc.normal.cross(side);
    for (int corner = 0; corner < 3; ++corner) {
      const auto turn = static_cast<float>(random.uniform(2.0 * corner, 2.0 * corner + 1.5));
      const Eigen::Vector3f at =
          disc.centre_m + disc.radius_m * (std::cos(turn) * side + std::sin(turn) * other);
      vertices += fmt::format("v {} {} {}\n", at.x(), at.y(), at.z());
    }
    faces += fmt::format("f {} {} {}\n", count + 1, count + 2, count + 3);
    count += 3;
  }
  folder.write("canopy.obj", vertices + faces);
  scene.discs.clear();
  scene.mesh = "canopy.obj";
  return scene;
}

void expect_reciprocal(bool triangles) {
  const TemporaryFolder folder;
  SceneText scene = two_faced_canopy(folder, triangles);
  scene.sampling = "samples = 65536";
  scene.sun = sun_at(60, 130);
  scene.sensor = views("[[15, 40], [45, 250]]");
  const SensorResult there = sensor_result(folder, scene, 1);
  scene.sensor = views("[[60, 130]]");
  const double places[2][2] = {{15, 40}, {45, 250}};
  for (std::size_t view = 0; view < 2; ++view) {
    scene.sun = sun_at(places[view][0], places[view][1]);
    const SensorResult back = sensor_result(folder, scene, 2);
    for (const Component component : {Component::all, Component::co_sgl, Component::mlt}) {
      const Estimates &a = part_of(there, Origin::total, component),
                      &b = part_of(back, Origin::total, component);
      EXPECT_LT(std::abs(z_of(a, view, b, 0)), 4)
          << name_of(component) << " of view " << view << ": " << a.value[view] << " and " << b.value[0];
      EXPECT_LT(b.standard_error[0], 0.02 * b.value[0]);  // small enough to bite
    }
  }
}

TEST(Reciprocity, SunAndViewChangePlacesOverDiscs) {
  expect_reciprocal(false);
}
TEST(Reciprocity, SunAndViewChangePlacesOverTriangles) {
  expect_reciprocal(true);
}

TEST(Reciprocity, HdrfUnderAnIsotropicSkyIsTheDhr) {
  const TemporaryFolder folder;
  SceneText scene = two_faced_canopy(folder, false);
  scene.sun = sun_at(50, 75);
  scene.sampling = "samples = 1024";
  const Mean to_hemisphere = dhr(folder, scene);
  scene.sun.clear();
  scene.sky = white_sky;
  scene.sensor = views("[[50, 75]]");
  scene.sampling = "samples = 65536";
  const SensorResult from_sky = sensor_result(folder, scene);
  const double hdrf = from_sky.radiance[0].value[0];
  const double error = std::hypot(to_hemisphere.error, from_sky.radiance[0].standard_error[0]);
  EXPECT_LT(error, 0.01 * hdrf);
  EXPECT_LT(std::abs(hdrf - to_hemisphere.value), 4 * error) << hdrf << " and " << to_hemisphere.value;
}

// Nothing absorbs: all that comes goes out again.
TEST(Reciprocity, DhrOfWhatAbsorbsNothingIsOne) {
  const TemporaryFolder folder;
  SceneText scene = two_faced_canopy(folder, false);
  scene.leaf = bilambertian("0.5", "0.5");
  scene.soil = lambertian("1");
  scene.sun = sun_at(35, 300);
  scene.sampling = "samples = 512\nroulette = false";
  const Mean all = dhr(folder, scene);
  EXPECT_LT(all.error, 0.01);
  EXPECT_LT(std::abs(all.value - 1), 4 * all.error) << all.value << " +- " << all.error;
}

}  // namespace
}  // namespace bpms::test
