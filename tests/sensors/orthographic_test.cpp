#include "simulate/sensors/orthographic.h"

#include "tests/sensors/sensor_text.h"

namespace bpms::test {
namespace {

const std::string plane =
    "type = \"orthographic\"\nlocation = [1, 2, 10]\ndirection = [0, 1, -1]\nwidth_px = 4\nheight_px = 2\n"
    "width_m = 8\n";

TEST(Orthographic, RaysAreParallelFromTheirPixelsOnThePlane) {
  SensorScene scene;
  const auto sensor = scene.read_as<OrthographicSensor>(plane);
  EXPECT_EQ(sensor->height_m, 4);  // square pixels
  const double c = std::sqrt(0.5);
  for (const std::size_t view : {0u, 5u, 7u}) {
    const Ray ray = sensor->start(view, middle, scene.extent);
    EXPECT_LT((ray.direction.cast<double>() - Eigen::Vector3d(0, c, -c)).norm(), single);
    const double x = -3 + 2.0 * static_cast<double>(view % 4), y = view < 4 ? -1 : 1;
    const Eigen::Vector3d expected(1 + x, 2 - c * y, 10 - c * y);  // down is (0, -c, -c)
    EXPECT_LT((ray.origin.cast<double>() - expected).norm(), 10 * single);
  }
}

TEST(Orthographic, ItsOneDirectionIsTowardsTheSensor) {
  SensorScene scene;
  const auto sensor = scene.read(plane);
  EXPECT_NEAR(sensor->vza_deg(3), 45, 1e-12);
  EXPECT_NEAR(sensor->vaa_deg(3), 180, 1e-12);  // it looks north, so it stands in the south
  ASSERT_TRUE(sensor->parallel(3));
  EXPECT_LT((*sensor->parallel(3) - Eigen::Vector3d(0, -1, 1).normalized()).norm(), 1e-15);
}

// Rays that start within the scene must not be answered by what lies above it.
TEST(Orthographic, IsParallelFromAboveOnlyWhereItIs) {
  SensorScene scene;
  const std::string size = "type = \"orthographic\"\nwidth_m = 1\nwidth_px = 1\nheight_px = 1\n";
  EXPECT_TRUE(scene.read(size + "location = [0, 0, 2.1]\ndirection = [0, 0, -1]")->parallel(0));
  EXPECT_FALSE(scene.read(size + "location = [0, 0, 1.9]\ndirection = [0, 0, -1]")->parallel(0));
  EXPECT_FALSE(scene.read(size + "location = [0, 0, 2.1]\ndirection = [1, 0, -1]")->parallel(0));
  EXPECT_FALSE(scene.read(size + "location = [0, 0, 3]\ndirection = [0, 0, 1]")->parallel(0));
}

}  // namespace
}  // namespace bpms::test
