#include "simulate/sensors/spherical.h"

#include "tests/sensors/sensor_text.h"

namespace bpms::test {
namespace {

std::string sphere(const std::string& rest, int side = 9) {
  return fmt::format("type = \"spherical\"\nlocation = [1, 2, 0]\nwidth_px = {0}\nheight_px = {0}\n{1}\n",
                     side, rest);
}
const std::string in = "direction = [0, 0, -1]\nradius_m = 50";

// The middle of a pixel at the right edge's middle, of 9: 8/9 of the way to 90 degrees.
TEST(Spherical, LookingInIsAMapOfTheViewDirections) {
  SensorScene scene;
  const auto sensor = scene.read(sphere(in));
  struct Case {
    std::size_t view;
    double vza_deg, vaa_deg;
  };
  for (const Case& c : {Case{4 * 9 + 4, 0, 0}, Case{4 * 9 + 8, 80, 90}, Case{4, 80, 0},
                        Case{8 * 9 + 4, 80, 180}, Case{4 * 9 + 2, 40, 270}}) {
    EXPECT_NEAR(sensor->vza_deg(c.view), c.vza_deg, 1e-9);
    if (c.vza_deg > 0) {
      EXPECT_NEAR(sensor->vaa_deg(c.view), c.vaa_deg, 1e-9);
    }
    const Ray ray = sensor->start(c.view, middle, scene.extent);
    const Eigen::Vector3d out =
        direction_from_angles(radians(c.vza_deg), radians(c.vaa_deg), scene.scene.domain);
    EXPECT_LT((ray.origin.cast<double>() - Eigen::Vector3d(1, 2, 0) - 50 * out).norm(), 100 * single);
    EXPECT_LT((ray.direction.cast<double>() + out).norm(), single);
  }
}

// Looking up with north at the top, west is at the right; all rays leave the centre.
TEST(Spherical, LookingOutIsAFisheyeLens) {
  SensorScene scene;
  const auto sensor = scene.read(sphere("looking = \"out\"\ndirection = [0, 0, 1]\nup = [0, 1, 0]"));
  const Ray right = sensor->start(4 * 9 + 8, middle, scene.extent);
  EXPECT_LT((right.origin.cast<double>() - Eigen::Vector3d(1, 2, 0)).norm(), single);
  EXPECT_LT(
      (right.direction.cast<double>() - Eigen::Vector3d(-std::sin(radians(80)), 0, std::cos(radians(80))))
          .norm(),
      single);
  EXPECT_NEAR(sensor->vza_deg(4 * 9 + 8), 100, 1e-9);
  EXPECT_NEAR(sensor->vaa_deg(4 * 9 + 8), 90, 1e-9);
}

TEST(Spherical, CornersAreNotPartOfTheImage) {
  SensorScene scene;
  const auto sensor = scene.read(sphere(in, 200));
  std::size_t covered = 0;
  Philox random(3);
  for (std::size_t view = 0; view < sensor->views(); ++view) {
    covered += sensor->covers(view) ? 1 : 0;
    EXPECT_EQ(sensor->covers(view), std::isfinite(sensor->vza_deg(view)));
    const Ray ray = sensor->start(view, numbers_of(random), scene.extent);
    EXPECT_NEAR(ray.direction.norm(), 1, single);
    EXPECT_LE(ray.direction.z(), 2e-7f);  // no ray comes from below the horizon
  }
  EXPECT_FALSE(sensor->covers(0));
  // A disc holds pi r^2 lattice points to within some r^(2/3).
  EXPECT_NEAR(static_cast<double>(covered), pi * 100 * 100, 3 * std::pow(100, 2.0 / 3));
}

// Equal area: z falls linearly with the square of the distance from the middle. So the mean of z over the
// image is 1/2, and equal-angle pixels, weighted by their solid angle sin(a)/a, say the same.
TEST(Spherical, EqualAreaPixelsHaveEqualSolidAngles) {
  SensorScene scene;
  constexpr int side = 200;
  for (const bool equal_area : {true, false}) {
    const auto sensor = scene.read(sphere(in + (equal_area ? "\nprojection = \"equal_area\"" : ""), side));
    double sum = 0, weights = 0;
    for (std::size_t view = 0; view < sensor->views(); ++view) {
      if (!sensor->covers(view)) continue;
      const double angle = std::max(1e-9, radians(sensor->vza_deg(view)));
      const double weight = equal_area ? 1 : std::sin(angle) / angle;
      sum += weight * std::cos(angle);
      weights += weight;
    }
    // The rim is a staircase: its pixels, 3 / 200 of all, are in or out by chance.
    EXPECT_NEAR(sum / weights, 0.5, 1e-3);
    EXPECT_NEAR(weights * (equal_area ? 2 * pi / (pi * side * side / 4) : std::pow(pi / side, 2)), 2 * pi,
                0.01);
  }
}

}  // namespace
}  // namespace bpms::test
