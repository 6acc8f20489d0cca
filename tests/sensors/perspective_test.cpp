#include "simulate/sensors/perspective.h"

#include "tests/sensors/sensor_text.h"

namespace bpms::test {
namespace {

const std::string down = "type = \"perspective\"\nlocation = [1, 2, 10]\ndirection = [0, 0, -1]\n";
const std::string small = "width_px = 8\nheight_px = 4\n";

// Tangents of the image's edges.
Eigen::Vector2d edges(const PerspectiveSensor& sensor) {
  const Eigen::Vector3d corner = sensor.line_of_sight(sensor.size.columns - 0.5, sensor.size.rows - 0.5);
  return {corner.dot(sensor.camera.right), corner.dot(sensor.camera.down)};
}

TEST(Perspective, ZoomOneIsAFieldOfNinetyDegrees) {
  SensorScene scene;
  const auto sensor = scene.read_as<PerspectiveSensor>(down + small + "zoom = 1");
  EXPECT_NEAR(edges(*sensor).y(), 1, 1e-15);
  EXPECT_NEAR(edges(*sensor).x(), 2, 1e-15);
  const auto field = scene.read_as<PerspectiveSensor>(down + small + "fov_deg = 90");
  EXPECT_NEAR(edges(*field).y(), 1, 1e-15);
}

TEST(Perspective, FocalLengthAndPixelSizeGiveTheField) {
  SensorScene scene;
  const auto sensor = scene.read_as<PerspectiveSensor>(
      down + "width_px = 6000\nheight_px = 4000\nfocal_length_mm = 50\npixel_size_um = [6, 7]");
  EXPECT_NEAR(edges(*sensor).x(), 18.0 / 50, 1e-15);
  EXPECT_NEAR(edges(*sensor).y(), 14.0 / 50, 1e-15);
}

TEST(Perspective, PixelsMayBeWiderThanHigh) {
  SensorScene scene;
  const auto sensor = scene.read_as<PerspectiveSensor>(down + small + "zoom = 2\npixel_aspect = 1.5");
  EXPECT_NEAR(edges(*sensor).y(), 0.5, 1e-15);
  EXPECT_NEAR(edges(*sensor).x(), 1.5, 1e-15);
}

// Pixel 0 is at the top left: north-west, looking down.
TEST(Perspective, RaysLeaveTheCentreWithinTheirPixel) {
  SensorScene scene;
  const auto sensor = scene.read(down + small + "zoom = 1");
  EXPECT_EQ(sensor->views(), 32u);
  EXPECT_EQ(sensor->width(), 8);
  EXPECT_EQ(sensor->height(), 4);
  EXPECT_FALSE(sensor->uses_aperture());
  const auto seen = [&](std::size_t view, double u, double v) {
    const Ray ray = sensor->start(view, {u, v}, scene.extent);
    EXPECT_LT((ray.origin.cast<double>() - Eigen::Vector3d(1, 2, 10)).norm(), single);
    EXPECT_NEAR(ray.direction.norm(), 1, single);
    return at_height(ray.origin.cast<double>(), ray.direction.cast<double>());
  };
  constexpr double near_m = 1e-4;  // 32-bit directions, at 10 m
  EXPECT_LT((seen(0, 0, 0) - Eigen::Vector3d(1 - 20, 2 + 10, 0)).norm(), near_m);
  EXPECT_LT((seen(0, 1, 1) - Eigen::Vector3d(1 - 15, 2 + 5, 0)).norm(), near_m);
  EXPECT_LT((seen(31, 1, 1) - Eigen::Vector3d(1 + 20, 2 - 10, 0)).norm(), near_m);
  EXPECT_LT((seen(12, 0, 1) - Eigen::Vector3d(1 + 0, 2 - 0, 0)).norm(), near_m);
}

TEST(Perspective, ALocationOnTheImagePlaneIsAFocalLengthBehindTheCentre) {
  SensorScene scene;
  const auto sensor = scene.read_as<PerspectiveSensor>(
      down + small + "focal_length_mm = 200\npixel_size_um = 9\nlocation_of = \"image_plane\"");
  EXPECT_LT((sensor->camera.location_m - Eigen::Vector3d(1, 2, 9.8)).norm(), 1e-15);
}

// Through any point of the lens, a pixel's point sees the same point of the plane of focus; the lens has the
// focal length over the f-number as its diameter, evenly filled.
TEST(Perspective, RaysOfAnApertureMeetInTheFocus) {
  SensorScene scene;
  const std::string field = down + small + "zoom = 1\n";
  const auto pinhole = scene.read_as<PerspectiveSensor>(field);
  const auto sensor =
      scene.read_as<PerspectiveSensor>(field + "focal_length_mm = 100\nf_stop = 2\nfocus_m = 7");
  EXPECT_TRUE(sensor->uses_aperture());
  Philox random(1);
  double most = 0, squares = 0;
  constexpr int count = 4000;
  for (int i = 0; i < count; ++i) {
    const SensorNumbers at = numbers_of(random);
    const std::size_t view = random.below(32);
    const Ray ray = sensor->start(view, at, scene.extent);
    const Ray chief = pinhole->start(view, at, scene.extent);
    const Eigen::Vector3d from = ray.origin.cast<double>() - sensor->camera.location_m;
    EXPECT_NEAR(from.z(), 0, single);
    most = std::max(most, from.norm());
    squares += from.squaredNorm() / count;
    const Eigen::Vector3d seen = at_height(ray.origin.cast<double>(), ray.direction.cast<double>(), 3);
    const Eigen::Vector3d middle_seen =
        at_height(chief.origin.cast<double>(), chief.direction.cast<double>(), 3);
    EXPECT_LT((seen - middle_seen).norm(), 2e-5);
  }
  EXPECT_LE(most, 0.025 + single);
  EXPECT_GT(most, 0.024);
  // Mean square r^2/2 of an even disc, with a standard deviation of r^2/sqrt(12).
  constexpr double r2 = 0.025 * 0.025;
  EXPECT_NEAR(squares, r2 / 2, 4 * r2 / std::sqrt(12.0 * count));
}

}  // namespace
}  // namespace bpms::test
