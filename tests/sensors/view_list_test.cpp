#include "simulate/sensors/view_list.h"

#include <cmath>

#include "tests/sensors/sensor_text.h"

namespace bpms::test {
namespace {

TEST(ViewList, HemisphereIsNadirAndRings) {
  SensorScene scene;
  const auto sensor = scene.read("type = \"brf\"\nhemisphere = { zeniths = 3, azimuths = 4, most_deg = 60 }");
  ASSERT_EQ(sensor->views(), 13u);
  EXPECT_EQ(sensor->vza_deg(0), 0);
  EXPECT_EQ(sensor->vza_deg(1), 20);
  EXPECT_EQ(sensor->vza_deg(12), 60);
  EXPECT_EQ(sensor->vaa_deg(12), 270);
  const Ray ray = sensor->start(12, middle, scene.extent);
  EXPECT_LT((ray.direction.cast<double>() - Eigen::Vector3d(std::sin(radians(60)), 0, -std::cos(radians(60))))
                .norm(),
            single);
}

TEST(ViewList, PlanesTurnWithTheSun) {
  SensorScene scene;
  const auto principal = scene.read("type = \"brf\"\nplane = \"principal\"\nvza_deg = [-30, 30]");
  EXPECT_EQ(principal->vaa_deg(0), 200);
  // At vza = -sza the view looks from the sun.
  EXPECT_LT((*principal->parallel(0) - scene.light.suns[0].direction).norm(), 1e-15);
  EXPECT_EQ(scene.read("type = \"brf\"\nplane = \"cross\"\nvza_deg = 30")->vaa_deg(0), 110);
}

}  // namespace
}  // namespace bpms::test
