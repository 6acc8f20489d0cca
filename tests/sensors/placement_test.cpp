#include "simulate/sensors/placement.h"

#include "tests/sensors/sensor_text.h"

namespace bpms::test {
namespace {

SensorPose placement_of(const std::string& text) {
  const SensorScene scene;
  return read_placement(TomlDocument::parse("scene.toml", text).root(), scene.scene);
}

TEST(SensorPlacement, LooksDownWithNorthAtTheTop) {
  const SensorPose at = placement_of("location = [1, 2, 3]\ndirection = [0, 0, -2]");
  EXPECT_LT((at.look - Eigen::Vector3d(0, 0, -1)).norm(), 1e-15);
  EXPECT_LT((at.right - Eigen::Vector3d(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((at.down - Eigen::Vector3d(0, -1, 0)).norm(), 1e-15);
}

TEST(SensorPlacement, LooksNorthWithEastAtTheRight) {
  const SensorPose at = placement_of("location = [1, 2, 3]\nlook_at = [1, 5, 3]");
  EXPECT_LT((at.right - Eigen::Vector3d(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((at.down - Eigen::Vector3d(0, 0, -1)).norm(), 1e-15);
}

TEST(SensorPlacement, UpTurnsTheImage) {
  const SensorPose at = placement_of("location = [1, 2, 3]\ndirection = [0, 1, 0]\nup = [1, 7, 0]");
  EXPECT_LT((at.down - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-15);
  EXPECT_NEAR(at.look.dot(at.right.cross(at.down)), 1, 1e-15);
}

TEST(SensorPlacement, AnglesAreThoseOfTheScenesConvention) {
  Domain domain;
  for (const bool north : {true, false}) {
    domain.azimuth_north_clockwise = north;
    for (const double azimuth_deg : {0.0, 40.0, 200.0, 359.0}) {
      const Angles back = angles_of(direction_from_angles(radians(65), radians(azimuth_deg), domain), domain);
      EXPECT_NEAR(back.zenith_deg, 65, 1e-12);
      EXPECT_NEAR(back.azimuth_deg, azimuth_deg, 1e-12);
    }
  }
}

TEST(SensorPlacement, TheHighestPointCountsInstancesAndTheirScale) {
  SensorScene scene;
  EXPECT_DOUBLE_EQ(highest_m(scene.scene), 2);
  scene.scene.instances.push_back({0, {0, 0, 1}, 0, 3});
  EXPECT_DOUBLE_EQ(highest_m(scene.scene), 7);
}

}  // namespace
}  // namespace bpms::test
