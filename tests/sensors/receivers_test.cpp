// The albedo camera and the radiometer: where their rays go.
#include <algorithm>

#include "simulate/sensors/albedo.h"
#include "tests/chi_square.h"
#include "tests/sensors/sensor_text.h"

namespace bpms::test {
namespace {

constexpr int draws = 20000, rings = 20, slices = 24;
constexpr double far_off = 4;  // standard deviations

// Counts over equal steps of f(cos to the axis) in (0, 1) and of azimuth about it: even where f has its law.
template <class Law>
double unevenness(const Sensor& sensor, std::size_t view, const Extent& extent, const Eigen::Vector3d& axis,
                  Law law) {
  std::vector<double> counts(rings * slices);
  const Eigen::Vector3d across = axis.unitOrthogonal(), along = axis.cross(across);
  Philox random(11);
  for (int i = 0; i < draws; ++i) {
    const Eigen::Vector3d to = sensor.start(view, numbers_of(random), extent).direction.cast<double>();
    const int ring = std::clamp(static_cast<int>(law(to.dot(axis)) * rings), 0, rings - 1);
    const double turn = (std::atan2(to.dot(along), to.dot(across)) + pi) / (2 * pi);
    const int slice = std::clamp(static_cast<int>(turn * slices), 0, slices - 1);
    ++counts[static_cast<std::size_t>(ring * slices + slice)];
  }
  return chi_square(counts, std::vector<double>(counts.size(), 1.0 * draws / (rings * slices))).z();
}
double sine_squared(double cosine) {
  return 1 - cosine * cosine;
}

TEST(Albedo, RaysFollowTheCosine) {
  SensorScene scene;
  const auto down = scene.read("type = \"albedo\"");
  EXPECT_LT(unevenness(*down, 0, scene.extent, {0, 0, -1}, sine_squared), far_off);
  const auto up = scene.read("type = \"albedo\"\nlooking = \"up\"\nheight_m = 0.5");
  EXPECT_LT(unevenness(*up, 0, scene.extent, {0, 0, 1}, sine_squared), far_off);
}

TEST(Albedo, ItsFaceIsTheOneThatReceives) {
  SensorScene scene;
  const auto down = scene.read("type = \"albedo\"");
  EXPECT_EQ(down->measures(), Measures::irradiance);
  EXPECT_TRUE(down->uses_aperture());
  EXPECT_FALSE(down->is_image());
  EXPECT_EQ(down->faces(0)->z(), -1);
  EXPECT_EQ(scene.read("type = \"albedo\"\nlooking = \"up\"\nheight_m = 0.5")->faces(0)->z(), 1);
}

TEST(Albedo, TheApertureIsTheCellAboveAllOrAtAHeight) {
  SensorScene scene;
  const auto top = scene.read("type = \"albedo\"");
  const auto inside = scene.read("type = \"albedo\"\nlooking = \"up\"\nheight_m = 0.5");
  const auto ground = scene.read("type = \"albedo\"\nlooking = \"up\"\nheight_m = 0");
  const Eigen::Vector3f at = top->start(0, {0.25, 0.75, 0.5, 0.5}, scene.extent).origin;
  EXPECT_FLOAT_EQ(at.x(), -2.5f);
  EXPECT_FLOAT_EQ(at.y(), 1.5f);
  EXPECT_GT(at.z(), 2.0f);
  EXPECT_LT(at.z(), 2.001f);
  EXPECT_FLOAT_EQ(inside->start(0, middle, scene.extent).origin.z(), 0.5f);
  EXPECT_GT(ground->start(0, middle, scene.extent).origin.z(), 0.0f);  // or the ground would be met at once
}

TEST(Albedo, OrItIsADisc) {
  SensorScene scene;
  const auto pinhole = scene.read("type = \"albedo\"\nlocation = [1, 2, 3]");
  const auto disc = scene.read("type = \"albedo\"\nlocation = [1, 2, 3]\nradius_m = 0.5");
  Philox random(5);
  double most = 0;
  for (int i = 0; i < 1000; ++i) {
    const SensorNumbers numbers = numbers_of(random);
    const Eigen::Vector3d centre(1, 2, 3);
    EXPECT_LT((pinhole->start(0, numbers, scene.extent).origin.cast<double>() - centre).norm(), single);
    const Eigen::Vector3d off = disc->start(0, numbers, scene.extent).origin.cast<double>() - centre;
    EXPECT_NEAR(off.z(), 0, single);
    most = std::max(most, off.norm());
  }
  EXPECT_NEAR(most, 0.5, 0.005);
}

// Pixels are equal parts of the cosine-weighted hemisphere: rows from the axis, columns from north clockwise.
TEST(Albedo, SectorsShareTheHemisphere) {
  SensorScene scene;
  const auto sensor = scene.read("type = \"albedo\"\nzeniths = 4\nazimuths = 8");
  EXPECT_EQ(sensor->views(), 32u);
  EXPECT_EQ(sensor->width(), 8);
  EXPECT_EQ(sensor->height(), 4);
  Philox random(6);
  for (std::size_t view = 0; view < 32; ++view)
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d to =
          sensor->start(view, numbers_of(random), scene.extent).direction.cast<double>();
      EXPECT_EQ(static_cast<std::size_t>(4 * (1 - to.z() * to.z())), view / 8);
      const double turn = std::atan2(to.x(), to.y()) / (2 * pi);
      EXPECT_EQ(static_cast<std::size_t>(8 * (turn < 0 ? turn + 1 : turn)), view % 8);
      EXPECT_LT(to.z(), 0);
    }
}

const std::string tilted = "type = \"radiometer\"\nlocation = [1, 2, 3]\ndirection = [1, 0, -1]\n";
const Eigen::Vector3d tilt = Eigen::Vector3d(1, 0, -1).normalized();

TEST(Radiometer, ConeIsEvenlyFilled) {
  SensorScene scene;
  const auto sensor = scene.read(tilted + "fov_deg = 20");
  EXPECT_EQ(sensor->measures(), Measures::radiance);
  EXPECT_NEAR(sensor->vza_deg(0), 45, 1e-12);
  EXPECT_NEAR(sensor->vaa_deg(0), 270, 1e-12);
  const double edge = 1 - std::cos(radians(10));
  Philox random(7);
  double most = 0;
  for (int i = 0; i < 1000; ++i)
    most = std::max(
        most, 1 - sensor->start(0, numbers_of(random), scene.extent).direction.cast<double>().dot(tilt));
  EXPECT_NEAR(most, edge, 0.01 * edge);
  EXPECT_LT(unevenness(*sensor, 0, scene.extent, tilt, [&](double cosine) { return (1 - cosine) / edge; }),
            far_off);
}

TEST(Radiometer, OfNoAngleIsOneRay) {
  SensorScene scene;
  const auto sensor = scene.read(tilted + "fov_deg = 0");
  EXPECT_LT((sensor->start(0, {0.1, 0.9}, scene.extent).direction.cast<double>() - tilt).norm(), single);
}

TEST(Radiometer, WithACosineMeasuresIrradiance) {
  SensorScene scene;
  const auto sensor = scene.read(tilted + "cosine = true");
  EXPECT_EQ(sensor->measures(), Measures::irradiance);
  EXPECT_LT((*sensor->faces(0) - tilt).norm(), 1e-15);
  EXPECT_LT(unevenness(*sensor, 0, scene.extent, tilt, sine_squared), far_off);
}

}  // namespace
}  // namespace bpms::test
