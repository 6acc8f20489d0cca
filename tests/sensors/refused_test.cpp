// Sensors that cannot be meant are refused in one line, at the key.
#include "tests/sensors/sensor_text.h"

namespace bpms::test {
namespace {

struct Refused {
  std::string body;
  const char* message;
};

void expect_refused(const std::string& type, const std::vector<Refused>& cases) {
  for (const Refused& c : cases) {
    SCOPED_TRACE(type + ": " + c.body);
    SensorScene scene;
    BPMS_EXPECT_ERROR(scene.read_all("type = \"" + type + "\"\n" + c.body), ErrorKind::bad_input, c.message);
  }
}

TEST(SensorRefused, Perspective) {
  const std::string at = "location = [0, 0, 5]\nlook_at = [1, 0, 0]\n";
  const std::string size = "width_px = 4\nheight_px = 4\n";
  expect_refused(
      "perspective",
      {{"look_at = [1, 0, 0]\nzoom = 1\n" + size, "missing key 'location'"},
       {"locaton = [0, 0, 5]\nlook_at = [1, 0, 0]\nzoom = 1\n" + size, "locaton"},
       {"location = [0, 0, -1]\nlook_at = [1, 0, 0]\nzoom = 1\n" + size,
        "scene.toml:3:12: location: a sensor at z"},
       {"location = [0, 0, 2e7]\nlook_at = [1, 0, 0]\nzoom = 1\n" + size, "within 1e7 m"},
       {"location = [0, 0]\nlook_at = [1, 0, 0]\nzoom = 1\n" + size, "location"},
       {"location = [0, 0, 5]\nlook_at = [0, 0, 5]\nzoom = 1\n" + size, "away from the sensor"},
       {"location = [0, 0, 5]\ndirection = [0, 0, 0]\nzoom = 1\n" + size, "a vector with a length"},
       {"location = [0, 0, 5]\nzoom = 1\n" + size, "one of look_at and direction"},
       {at + "direction = [0, 0, -1]\nzoom = 1\n" + size, "one of look_at and direction"},
       {at + "up = [1, 0, -5]\nzoom = 1\n" + size, "up is parallel to the line of sight"},
       {at + "up = [0, 0, 0]\nzoom = 1\n" + size, "a vector with a length"},
       {at + "zoom = 1\nwidth_px = 0\nheight_px = 4", "width_px"},
       {at + "zoom = 1\nwidth_px = 4\nheight_px = 30000", "height_px"},
       {at + "zoom = 1\nwidth_px = 4", "missing key 'height_px'"},
       {at + size, "one of zoom, fov_deg and pixel_size_um"},
       {at + size + "zoom = 1\nfov_deg = 30", "one of zoom, fov_deg and pixel_size_um"},
       {at + size + "zoom = 0", "zoom"},
       {at + size + "zoom = 1e-9", "the field is 180 degrees wide"},
       {at + size + "fov_deg = 180", "fov_deg"},
       {at + size + "fov_deg = 90\npixel_aspect = 1000", "the field is"},
       {at + size + "pixel_size_um = 5", "missing key 'focal_length_mm'"},
       {at + size + "pixel_size_um = [5, 5, 5]\nfocal_length_mm = 50", "or [width, height]"},
       {at + size + "pixel_size_um = 5\nfocal_length_mm = 50\npixel_aspect = 2", "says it already"},
       {at + size + "zoom = 1\nfocal_length_mm = 50", "f_stop or location_of with it"},
       {at + size + "zoom = 1\nf_stop = 2\nfocal_length_mm = 50", "missing key 'focus_m'"},
       {at + size + "zoom = 1\nf_stop = 2\nfocus_m = 3", "missing key 'focal_length_mm'"},
       {at + size + "zoom = 1\nfocus_m = 3", "a pinhole has no focus"},
       {at + size + "zoom = 1\nf_stop = 2\nfocus_m = 0.04\nfocal_length_mm = 50", "beyond the focal length"},
       {at + size + "zoom = 1\nlocation_of = \"image_plane\"", "missing key 'focal_length_mm'"},
       {at + size + "zoom = 1\ncamera = \"left\"", "expected rig = \"rig.toml\" with it"}});
}

TEST(SensorRefused, Orthographic) {
  const std::string at = "location = [0, 0, 5]\ndirection = [1, 0, 0]\nwidth_px = 4\nheight_px = 4\n";
  expect_refused("orthographic",
                 {{at, "missing key 'width_m'"},
                  {at + "width_m = -1", "width_m"},
                  {at + "width_m = 1e8", "1e7"},
                  {at + "width_m = 4\nheight_m = 12", "a corner of the image plane at z = -1"},
                  {at + "width_m = 4\nfov_deg = 3", "fov_deg"}});
}

TEST(SensorRefused, Boom) {
  const std::string boom =
      "about = [0, 0, 0]\nviews = [[60, 0]]\narea_m = [4, 3]\nwidth_px = 40\nheight_px = 30\n";
  expect_refused("boom",
                 {{boom, "missing key"},
                  {boom + "distance_m = 1", "at 60 degrees the image plane at z = -0.149"},
                  {boom + "distance_m = 1\nprojection = \"perspective\"", "expected a longer boom"},
                  {boom + "distance_m = 9\nprojection = \"fisheye\"", "orthographic"},
                  {"about = [0, 0, 0]\nviews = [[90, 0]]\ndistance_m = 9\narea_m = [4, 3]\nwidth_px = 4\n"
                   "height_px = 3",
                   "at most 89"},
                  {"about = [0, 0, 0]\nviews = [[30, 0], [30, 0]]\ndistance_m = 9\narea_m = [4, 3]\n"
                   "width_px = 4\nheight_px = 3",
                   "two views at 30 degrees"},
                  {"about = [0, 0, 0]\nviews = [[30, 0]]\ndistance_m = 9\narea_m = 4\nwidth_px = 4\n"
                   "height_px = 3",
                   "expected [w, h] in metres"}});
}

TEST(SensorRefused, Spherical) {
  const std::string at = "location = [0, 0, 5]\ndirection = [0, 0, -1]\n",
                    size = "width_px = 4\nheight_px = 4\n";
  expect_refused("spherical", {{at + size, "missing key 'radius_m'"},
                               {at + "radius_m = 3\nwidth_px = 4\nheight_px = 5", "a circle in a square"},
                               {at + size + "radius_m = 3\nlooking = \"out\"", "rays start at the location"},
                               {at + size + "looking = \"around\"", "looking"},
                               {at + size + "radius_m = 3\nprojection = \"mercator\"", "equal_angle"},
                               {"location = [0, 0, 5]\ndirection = [0, 0, 1]\nradius_m = 6\n" + size,
                                "the hemisphere at z"}});
}

TEST(SensorRefused, Receivers) {
  expect_refused("albedo", {{"looking = \"up\"", "expected height_m or location"},
                            {"looking = \"sideways\"", "looking"},
                            {"height_m = -1", "below the ground"},
                            {"radius_m = 1", "expected location with it"},
                            {"location = [0, 0, 1]\nheight_m = 2", "says the height already"},
                            {"location = [0, 0, 1]\nradius_m = -2", "radius_m"},
                            {"zeniths = 0", "zeniths"}});
  const std::string at = "location = [0, 0, 5]\ndirection = [0, 0, -1]\n";
  expect_refused("radiometer", {{at, "expected fov_deg"},
                                {at + "fov_deg = 181", "fov_deg"},
                                {at + "fov_deg = 10\ncosine = true", "expected no fov_deg"}});
}

TEST(SensorRefused, Lists) {
  expect_refused("brf",
                 {{"", "expected one of plane"},
                  {"views = [[0, 0]]\nhemisphere = { zeniths = 2, azimuths = 4 }", "expected one of plane"},
                  {"hemisphere = { zeniths = 0, azimuths = 4 }", "hemisphere.zeniths"},
                  {"hemisphere = { zeniths = 2, azimuths = 4, most_deg = 90 }", "hemisphere.most_deg"},
                  {"views = [[0, 0]]\nvza_deg = 3", "with plane only"},
                  {"views = [[90, 0]]", "at most 89"},
                  {"views = []", "at least one"}});
  expect_refused("rays", {{"", "missing key 'file'"}});
  expect_refused("lidar", {{"", "not built yet"}});
  expect_refused("camera", {{"", "perspective"}});
}

TEST(SensorRefused, TheSunsPlaneWithoutASun) {
  SensorScene scene;
  scene.light.suns.clear();
  BPMS_EXPECT_ERROR(scene.read("type = \"brf\"\nplane = \"cross\"\nvza_deg = 3"), ErrorKind::bad_input,
                    "need a sun");
}

TEST(SensorRefused, ASeriesWhereOneIsWanted) {
  SensorScene scene;
  const TomlDocument document = TomlDocument::parse(
      "scene.toml",
      "name = \"eye\"\ntype = \"boom\"\nabout = [0, 0, 0]\nviews = [[0, 0], [30, 0]]\ndistance_m = 9\n"
      "area_m = [1, 1]\nwidth_px = 4\nheight_px = 4");
  BPMS_EXPECT_ERROR(read_sensor(document.root(), {scene.scene, scene.light, scene.inputs, scene.notes}),
                    ErrorKind::bad_input, "it stands for 2 sensors");
}

}  // namespace
}  // namespace bpms::test
