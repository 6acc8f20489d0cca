// Which mode a sensor is traced in.
#include "simulate/forward/choose_mode.h"

#include <gmock/gmock.h>

#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

Mode chosen(const TemporaryFolder& folder, const SceneText& scene, Mode asked = Mode::automatic) {
  const Simulation simulation = simulation_of(folder, scene);
  return choose_mode(asked, simulation, *simulation.sensors[0], {"scene.toml", 3, 1});
}

TEST(ChooseMode, ByTheCostOfWhatIsAskedFor) {
  const TemporaryFolder folder;
  SceneText scene = canopy_text(folder, {.lai = 1, .size_m = {2, 2}, .bottom_m = 0.1});
  scene.sun = sun_at(30, 0);
  scene.sampling = "samples = 1024";
  scene.sensor = principal_plane("{ from = -60, to = 60, step = 10 }");
  EXPECT_EQ(chosen(folder, scene), Mode::forward);
  EXPECT_EQ(chosen(folder, scene, Mode::reverse), Mode::reverse);
  scene.sensor = views("[[0, 0]]");
  EXPECT_EQ(chosen(folder, scene), Mode::reverse);
  EXPECT_EQ(chosen(folder, scene, Mode::forward), Mode::forward);
  scene.sensor = camera("[0, 0, 5]", "look_at = [0, 0, 0]\nzoom = 1", 8, 8);
  EXPECT_EQ(chosen(folder, scene), Mode::reverse);
  BPMS_EXPECT_ERROR(chosen(folder, scene, Mode::forward), ErrorKind::bad_input, "not parallel");
  scene.domain += "\nboundary = \"open\"";
  scene.sensor = principal_plane("{ from = -60, to = 60, step = 10 }");
  EXPECT_EQ(chosen(folder, scene), Mode::reverse);
  BPMS_EXPECT_ERROR(chosen(folder, scene, Mode::forward), ErrorKind::bad_input, "open");
}

}  // namespace
}  // namespace bpms::test
