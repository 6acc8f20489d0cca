#include "tests/sensors/sensor_text.h"

namespace bpms::test {
namespace {

constexpr const char* list = "type = \"rays\"\nfile = \"rays.csv\"\n";

std::unique_ptr<Sensor> rays_of(SensorScene& scene, const TemporaryFolder& folder, const std::string& csv,
                                const std::string& more = "") {
  folder.write("rays.csv", csv);
  return scene.read(list + more, folder / "scene.toml");
}

TEST(RayList, EachRowIsAViewOfItsOwn) {
  const TemporaryFolder folder;
  SensorScene scene;
  const auto sensor = rays_of(scene, folder, "x_m,y_m,z_m,dx,dy,dz\n1,2,3,0,0,-2\n4,5,6,0,1,-1\n");
  ASSERT_EQ(sensor->views(), 2u);
  EXPECT_FALSE(sensor->uses_aperture());
  const Ray ray = sensor->start(1, {0.2, 0.3}, scene.extent);
  EXPECT_EQ(ray.origin, Eigen::Vector3f(4, 5, 6));
  EXPECT_LT((ray.direction.cast<double>() - Eigen::Vector3d(0, 1, -1).normalized()).norm(), single);
  EXPECT_EQ(sensor->vza_deg(0), 0);
  EXPECT_NEAR(sensor->vza_deg(1), 45, 1e-9);
  EXPECT_NEAR(sensor->vaa_deg(1), 180, 1e-9);
}

TEST(RayList, RaysOfAViewAreTakenByTheirWeight) {
  const TemporaryFolder folder;
  SensorScene scene;
  const auto sensor = rays_of(scene, folder,
                              "view,x_m,y_m,z_m,dx,dy,dz,weight\nb,1,0,9,0,0,-1,3\na,2,0,9,0,0,-1,1\n"
                              "b,3,0,9,0,1,-1,1\nb,4,0,9,0,0,-1,0\n");
  ASSERT_EQ(sensor->views(), 2u);
  const auto x = [&](double u) { return sensor->start(0, {u, 0.5}, scene.extent).origin.x(); };
  EXPECT_EQ(x(0.01), 1);
  EXPECT_EQ(x(0.749), 1);
  EXPECT_EQ(x(0.751), 3);
  EXPECT_EQ(x(0.999), 3);
  EXPECT_EQ(sensor->start(1, middle, scene.extent).origin.x(), 2);
  EXPECT_TRUE(std::isnan(sensor->vza_deg(0)));
  EXPECT_EQ(sensor->vza_deg(1), 0);
}

TEST(RayList, RaysMaySpread) {
  const TemporaryFolder folder;
  SensorScene scene;
  const auto sensor =
      rays_of(scene, folder, "x_m,y_m,z_m,dx,dy,dz,half_angle_deg\n1,2,3,0,0,-2,5\n1,2,3,0,0,-1,0\n",
              "width_px = 2\nheight_px = 1\n");
  EXPECT_TRUE(sensor->is_image());
  EXPECT_TRUE(sensor->uses_aperture());
  Philox random(2);
  double most = 0;
  for (int i = 0; i < 1000; ++i) {
    const SensorNumbers numbers = numbers_of(random);
    most = std::max(most, std::acos(-1.0 * sensor->start(0, numbers, scene.extent).direction.z()));
    EXPECT_EQ(sensor->start(1, numbers, scene.extent).direction.z(), -1);
  }
  EXPECT_NEAR(degrees(most), 5, 0.05);
}

TEST(RayList, RefusesWithRowAndColumn) {
  struct Case {
    std::string csv;
    const char* message;
  };
  const std::string head = "x_m,y_m,z_m,dx,dy,dz";
  const Case cases[] = {
      {head + "\n", "no rays"},
      {"x_m,y_m,z_m,dx,dy\n1,2,3,0,0\n", "rays.csv:1"},
      {head + "\n1,2,3,0,0,0\n", "rays.csv:2:7: the direction is (0, 0, 0)"},
      {head + "\n1,2,3,0,0,-1\n1,2,x,0,0,-1\n", "rays.csv:3:5"},
      {head + "\n1,2,-3,0,0,-1\n", "rays.csv:2:5: z = -3 m lies below the ground"},
      {head + "\n1e8,2,3,0,0,-1\n", "within 1e7 m"},
      {head + ",weight\n1,2,3,0,0,-1,1\n", "without a column view"},
      {head + ",view,weight\n1,2,3,0,0,-1,a,-1\n", "rays.csv:2:16: weight -1"},
      {head + ",view,weight\n1,2,3,0,0,-1,a,0\n", "add up to 0"},
      {head + ",view\n1,2,3,0,0,-1,\n", "expected the name of a view"},
      {head + ",half_angle_deg\n1,2,3,0,0,-1,91\n", "half_angle_deg 91: expected 0 to 90"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.csv);
    const TemporaryFolder folder;
    SensorScene scene;
    BPMS_EXPECT_ERROR(rays_of(scene, folder, c.csv), ErrorKind::bad_input, c.message);
  }
  const TemporaryFolder folder;
  SensorScene scene;
  BPMS_EXPECT_ERROR(rays_of(scene, folder, head + "\n1,2,3,0,0,-1\n", "width_px = 2\nheight_px = 1\n"),
                    ErrorKind::bad_input, "has 1 views");
}

}  // namespace
}  // namespace bpms::test
