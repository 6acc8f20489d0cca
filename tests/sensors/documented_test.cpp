// The examples of docs/sensors.md are read as they stand.
#include "core/text.h"
#include "tests/sensors/sensor_text.h"

namespace bpms::test {
namespace {

std::vector<std::string> toml_blocks(const std::string& text) {
  std::vector<std::string> out;
  const std::string open = "```toml\n", close = "```";
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    at += open.size();
    const std::size_t end = text.find(close, at);
    out.push_back(text.substr(at, end - at));
    at = end;
  }
  return out;
}

TEST(DocumentedSensors, AreRead) {
  const TemporaryFolder folder;
  folder.write(
      "rig.toml",
      "units = \"m\"\npixel_centre = \"integer\"\n[[cameras]]\nname = \"left\"\nsize_px = [640, 480]\n"
      "model = \"brown_conrady\"\nparameters = [533, 534, 320, 240]\n"
      "cam_from_rig = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]\n");
  folder.write("scan.csv", "x_m,y_m,z_m,dx,dy,dz\n0,0,3,0,0,-1\n");
  std::string kinds;
  for (const std::string& block : toml_blocks(read_text(BPMS_SOURCE_DIR "/docs/sensors.md"))) {
    SCOPED_TRACE(block);
    SensorScene scene;
    const TomlDocument document = TomlDocument::parse(folder / "scene.toml", block);
    const TomlValue sensors = document.root().require("sensors");
    for (std::size_t i = 0; i < sensors.size(); ++i)
      for (const auto& sensor :
           read_sensors(sensors[i], {scene.scene, scene.light, scene.inputs, scene.notes})) {
        EXPECT_GT(sensor->views(), 0u);
        EXPECT_NEAR(sensor->start(sensor->views() / 2, middle, scene.extent).direction.norm(), 1, single);
        kinds += sensor->type + " ";
      }
    document.finish();
  }
  EXPECT_EQ(kinds,
            "brf perspective perspective orthographic boom boom boom boom boom spherical albedo albedo "
            "radiometer rays ");
}

}  // namespace
}  // namespace bpms::test
