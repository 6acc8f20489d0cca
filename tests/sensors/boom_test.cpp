// Figures 9 and 10 of the paper: every view of the boom sees the same ground.
#include "simulate/sensors/boom.h"

#include "tests/sensors/sensor_text.h"

namespace bpms::test {
namespace {

const std::string figure_10 =
    "type = \"boom\"\nabout = [1, -1, 0.5]\nplane = \"principal\"\n"
    "vza_deg = { from = -60, to = 60, step = 30 }\ndistance_m = 10\narea_m = [4, 3]\nwidth_px = 40\n"
    "height_px = 30\n";

// Across the plane of the boom, to the right as seen from positive zeniths, and along it towards them.
struct BoomPlane {
  Eigen::Vector3d about{1, -1, 0.5};
  Eigen::Vector3d along = direction_from_angles(pi / 2, radians(200), {});
  Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(along);
  Eigen::Vector2d of(const Eigen::Vector3d& point) const {
    return {(point - about).dot(across), (point - about).dot(along)};
  }
};

TEST(Boom, FiveOrthographicViewsSeeTheSameCorners) {
  SensorScene scene;
  const SensorList views = scene.read_all(figure_10);
  ASSERT_EQ(views.size(), 5u);
  const char* const names[] = {"eye_m60", "eye_m30", "eye_0", "eye_30", "eye_60"};
  const int rows[] = {15, 26, 30, 26, 15};
  const BoomPlane ground;
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& view = dynamic_cast<const OrthographicSensor&>(*views[i]);
    EXPECT_EQ(view.name, names[i]);
    EXPECT_EQ(view.type, "boom");
    EXPECT_EQ(view.vza_deg(0), -60 + 30.0 * static_cast<double>(i));
    EXPECT_EQ(view.vaa_deg(0), 200);
    EXPECT_EQ(view.size.columns, 40);
    EXPECT_EQ(view.size.rows, rows[i]);
    // Seen from the side of negative zeniths the image is turned by half a circle: the far edge is on top.
    const double side = i < 2 ? -1 : 1;
    for (const double x : {-0.5, 39.5})
      for (const double y : {-0.5, rows[i] - 0.5}) {
        const Eigen::Vector2d seen = ground.of(at_height(view.point(x, y), view.camera.look, 0.5));
        const Eigen::Vector2d corner(x < 0 ? -2 : 2, y < 0 ? -1.5 : 1.5);
        EXPECT_LT((seen - side * corner).norm(), 1e-12) << view.name << " " << seen.transpose();
      }
    // The pixel of the ray that is traced, in 32-bit floats.
    const Ray ray = view.start(0, {0, 0}, scene.extent);
    const Eigen::Vector2d first =
        ground.of(at_height(ray.origin.cast<double>(), ray.direction.cast<double>(), 0.5));
    EXPECT_LT((first - side * Eigen::Vector2d(-2, -1.5)).norm(), 2e-5);
  }
}

TEST(Boom, PerspectiveViewsSeeTheEndsOfTheCentreLines) {
  SensorScene scene;
  const SensorList views = scene.read_all(figure_10 + "projection = \"perspective\"");
  ASSERT_EQ(views.size(), 5u);
  const BoomPlane ground;
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& view = dynamic_cast<const PerspectiveSensor&>(*views[i]);
    const double side = i < 2 ? -1 : 1;
    EXPECT_NEAR((view.camera.location_m - ground.about).norm(), 10, 1e-12);
    EXPECT_LT((view.camera.right.cross(view.camera.down) - view.camera.look).norm(), 1e-15);
    const auto seen = [&](double column, double row) {
      return Eigen::Vector2d(
          side * ground.of(at_height(view.camera.location_m, view.line_of_sight(column, row), 0.5)));
    };
    EXPECT_LT((seen(19.5, -0.5) - Eigen::Vector2d(0, -1.5)).norm(), 1e-12) << view.name;
    EXPECT_LT((seen(19.5, view.size.rows - 0.5) - Eigen::Vector2d(0, 1.5)).norm(), 1e-12) << view.name;
    // The row in which the point itself is seen.
    const Eigen::Vector3d sight = ground.about - view.camera.location_m;
    const double tangent = sight.dot(view.camera.down) / sight.dot(view.camera.look);
    const double row = 0.5 * view.size.rows * (1 + tangent / view.semi_height) - 0.5;
    EXPECT_LT((seen(-0.5, row) - Eigen::Vector2d(-2, 0)).norm(), 1e-12) << view.name;
    EXPECT_LT((seen(39.5, row) - Eigen::Vector2d(2, 0)).norm(), 1e-12) << view.name;
    // The rectangle's image is a trapezoid: the near edge's ground is narrower than the far edge's.
    if (std::abs(view.zenith_deg) > 1) {
      EXPECT_GT(seen(39.5, -0.5).x(), seen(39.5, view.size.rows - 0.5).x());
    }
  }
}

// tan(a) of the edges: 1.5 cos 60 / (10 -+ 1.5 sin 60).
TEST(Boom, FieldFollowsFigure9) {
  const BoomField field = boom_field(3, 10, radians(60));
  EXPECT_NEAR(std::tan(field.near_edge), 0.75 / (10 - 1.2990381056766580), 1e-15);
  EXPECT_NEAR(std::tan(field.far_edge), 0.75 / (10 + 1.2990381056766580), 1e-15);
  EXPECT_LT(field.near_edge + field.far_edge, 2 * std::atan(0.15));  // less than at nadir
}

TEST(Boom, AViewsAzimuthIsInItsNameWhereTheyDiffer) {
  SensorScene scene;
  const SensorList views = scene.read_all(
      "type = \"boom\"\nabout = [0, 0, 0]\nviews = [[30, 0], [30, 90], [57.5, -90]]\ndistance_m = 10\n"
      "area_m = [1, 1]\nwidth_px = 4\nheight_px = 4");
  ASSERT_EQ(views.size(), 3u);
  EXPECT_EQ(views[0]->name, "eye_30_0");
  EXPECT_EQ(views[1]->name, "eye_30_90");
  EXPECT_EQ(views[2]->name, "eye_57.5_m90");
  EXPECT_TRUE(views[0]->parallel(0));
}

}  // namespace
}  // namespace bpms::test
