// One scene stated in two ways gives one result, within the standard errors of both.
#include <gmock/gmock.h>

#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

SceneText coarse_canopy(const TemporaryFolder& folder) {
  SceneText scene =
      canopy_text(folder, {.lai = 1.5, .radius_m = 0.1, .size_m = {1.5, 1.0}, .bottom_m = 0.1, .top_m = 0.8});
  scene.sun = sun_at(45, 60);
  scene.sky = white_sky;
  scene.sensor = views("[[10, 200], [55, 90]]");
  scene.sampling = "samples = 65536";
  return scene;
}

void expect_same(const Estimates& a, const Estimates& b, const std::string& what) {
  ASSERT_EQ(a.value.size(), b.value.size());
  for (std::size_t i = 0; i < a.value.size(); ++i) {
    EXPECT_LT(std::abs(z_of(a, i, b, i)), 4) << what << " " << i << ": " << a.value[i] << ", " << b.value[i];
    EXPECT_LT(a.standard_error[i], 0.01 * a.value[i]) << what;  // small enough to bite
  }
}

TEST(SameScene, LightOfTwoOriginsIsThatOfTwoRuns) {
  const TemporaryFolder folder;
  SceneText scene = coarse_canopy(folder);
  const SensorResult both = sensor_result(folder, scene, 1);
  scene.sky.clear();
  const SensorResult sun = sensor_result(folder, scene, 2);
  scene.sky = white_sky;
  scene.sun.clear();
  const SensorResult sky = sensor_result(folder, scene, 3);
  expect_same(part_of(both, Origin::direct), part_of(sun, Origin::total), "sun");
  expect_same(part_of(both, Origin::diffuse), part_of(sky, Origin::total), "sky");
}

TEST(SameScene, ACellIsSixOfItInALargerCell) {
  const TemporaryFolder folder;
  SceneText scene = coarse_canopy(folder);
  const SensorResult cell = sensor_result(folder, scene, 1);
  scene.domain = "size_m = [3, 3]";
  scene.positions =
      "[[-0.75, -1, 0], [0.75, -1, 0], [-0.75, 0, 0], [0.75, 0, 0], [-0.75, 1, 0], [0.75, 1, 0]]";
  const SensorResult cells = sensor_result(folder, scene, 2);
  expect_same(cell.radiance[0], cells.radiance[0], "radiance");
  expect_same(cell.gap, cells.gap, "gap");
}

}  // namespace
}  // namespace bpms::test
