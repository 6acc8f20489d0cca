// A simulated image has the geometry of the calibrated camera: what the rig projects into a pixel is what
// that pixel's ray sees.
#include <Eigen/Geometry>

#include "simulate/sensors/perspective.h"
#include "tests/sensors/sensor_text.h"

namespace bpms::test {
namespace {

constexpr std::size_t fisheye = 0;  // in place of a count of Brown-Conrady's parameters

Rig sample_rig(std::size_t parameters) {
  Rig rig;
  Camera camera;
  camera.name = "left";
  camera.width_px = 640;
  camera.height_px = 480;
  camera.parameters = {533.83,  534.1,    342.5, 234.82, -0.2871, 0.0902,
                       0.00119, -0.00022, 0.03,  0.02,   -0.01,   0.004};
  camera.parameters.resize(parameters == fisheye ? 8 : parameters);
  if (parameters == fisheye) {
    camera.model = "fisheye";
    camera.parameters = {330, 331, 322, 237, 0.03, -0.012, 0.005, -0.0007};
  }
  camera.r_cam_from_rig = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  camera.t_cam_from_rig_m = {-0.083, 0.001, 0.02};
  rig.cameras.push_back(camera);
  return rig;
}

std::string matrix_text(const Eigen::Matrix3d& r, const Eigen::Vector3d& t) {
  std::string out = "[";
  for (int i = 0; i < 3; ++i)
    out += fmt::format("[{:.17g}, {:.17g}, {:.17g}, {:.17g}], ", r(i, 0), r(i, 1), r(i, 2), t[i]);
  return out + "]";
}

class CalibratedCamera : public ::testing::TestWithParam<std::size_t> {};

TEST_P(CalibratedCamera, RayOfAPixelProjectsToIt) {
  const TemporaryFolder folder;
  const Rig rig = sample_rig(GetParam());
  folder.write("rig.toml", rig_toml(rig));
  SensorScene scene;
  const auto sensor = scene.read_as<PerspectiveSensor>(
      "type = \"perspective\"\nrig = \"rig.toml\"\ncamera = \"left\"\nlocation = [0, 0, 5]\n"
      "look_at = [1, 0, 0]",
      folder / "scene.toml");
  EXPECT_EQ(sensor->width(), 640);
  EXPECT_EQ(sensor->height(), 480);
  EXPECT_THAT(scene.inputs, ::testing::ElementsAre(folder / "rig.toml"));
  for (int column = 0; column < 640; column += 71)
    for (int row = 0; row < 480; row += 53) {
      const Eigen::Vector3d sight = sensor->line_of_sight(column, row);
      const Eigen::Vector3d x_cam(sight.dot(sensor->camera.right), sight.dot(sensor->camera.down),
                                  sight.dot(sensor->camera.look));
      const auto pixel = project(rig.cameras[0], x_cam);
      ASSERT_TRUE(pixel);
      EXPECT_NEAR(pixel->x(), column, 1e-6);
      EXPECT_NEAR(pixel->y(), row, 1e-6);
      // As traced, in 32-bit floats: the middle of the pixel.
      const auto view = static_cast<std::size_t>(row * 640 + column);
      const Eigen::Vector3d ray = sensor->start(view, middle, scene.extent).direction.cast<double>();
      EXPECT_LT((ray - sight.normalized()).norm(), 2e-7);
    }
}

// A point in the rig's frame, put into the scene, is seen along the ray of the pixel that the rig says.
TEST_P(CalibratedCamera, StandsAsInTheRig) {
  const TemporaryFolder folder;
  const Rig rig = sample_rig(GetParam());
  folder.write("rig.toml", rig_toml(rig));
  const Eigen::Matrix3d r =
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.2, 1, -0.4).normalized()).toRotationMatrix();
  const Eigen::Vector3d t(3, -1, 4);
  SensorScene scene;
  const auto sensor = scene.read_as<PerspectiveSensor>(
      "type = \"perspective\"\nrig = \"rig.toml\"\ncamera = \"left\"\nwidth_px = 640\nheight_px = 480\n"
      "scene_from_rig = " +
          matrix_text(r, t),
      folder / "scene.toml");
  const Camera& camera = rig.cameras[0];
  for (const Eigen::Vector3d& x_cam : {Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(0.5, -0.3, 1.5)}) {
    const Eigen::Vector3d x_rig = camera.r_cam_from_rig.transpose() * (x_cam - camera.t_cam_from_rig_m);
    const Eigen::Vector3d x_scene = r * x_rig + t;
    const auto pixel = project(camera, x_cam);
    ASSERT_TRUE(pixel);
    const Eigen::Vector3d seen = (x_scene - sensor->camera.location_m).normalized();
    EXPECT_LT((sensor->line_of_sight(pixel->x(), pixel->y()).normalized() - seen).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, CalibratedCamera, ::testing::Values(4, 8, 9, 12, fisheye));

TEST(CalibratedCameraRefused, WhatDoesNotFitTheRig) {
  const TemporaryFolder folder;
  Rig rig = sample_rig(8);
  folder.write("rig.toml", rig_toml(rig));
  rig.cameras[0].parameters[4] = -1.5;  // turns back within the image
  rig.cameras[0].parameters[5] = 0;
  folder.write("steep.toml", rig_toml(rig));
  rig = sample_rig(fisheye);
  rig.cameras[0].parameters = {200, 200, 320, 240, 0, 0, 0, 0};  // 115 degrees in the image's corners
  folder.write("wide.toml", rig_toml(rig));
  struct Case {
    std::string body;
    const char* message;
  };
  const std::string left = "rig = \"rig.toml\"\ncamera = \"left\"\n",
                    at = "location = [0, 0, 5]\nlook_at = [1, 0, 0]\n";
  const Case cases[] = {
      {"rig = \"rig.toml\"\ncamera = \"lefd\"\n" + at, "expected one of 'left'"},
      {left + at + "width_px = 320", "scene.toml:7:12: width_px: camera 'left' has 640 x 480 pixels"},
      {left + at + "height_px = 481", "640 x 480 pixels"},
      {left + at + "zoom = 2", "the rig's camera says its field"},
      {left, "expected one of scene_from_rig (the rig's own pose) and location"},
      {left + at + "scene_from_rig = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 5]]", "one of scene_from_rig"},
      {left + "scene_from_rig = [[1, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1, 5]]", "no rotation"},
      {left + "scene_from_rig = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -5]]", "below the ground"},
      {left + "up = [0, 1, 0]\nscene_from_rig = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 5]]",
       "says it already"},
      {"rig = \"wide.toml\"\ncamera = \"left\"\n" + at, "degrees off its axis: expected less than 89"},
      {"rig = \"steep.toml\"\ncamera = \"left\"\n" + at, "its distortion turns back there"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.body);
    SensorScene scene;
    BPMS_EXPECT_ERROR(scene.read("type = \"perspective\"\n" + c.body, folder / "scene.toml"),
                      ErrorKind::bad_input, c.message);
  }
}

}  // namespace
}  // namespace bpms::test
