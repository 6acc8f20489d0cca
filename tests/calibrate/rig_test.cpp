#include "calibrate/rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "calibrate/lenses/brown_conrady.h"

namespace bpms {
namespace {

// The left camera of OpenCV's sample rig; more parameters for the longer models.
Camera sample_camera(std::size_t count) {
  Camera camera;
  camera.name = "left";
  camera.width_px = 640;
  camera.height_px = 480;
  camera.parameters = {533.83,  534.1,    342.5, 234.82, -0.2871, 0.0902,
                       0.00119, -0.00022, 0.03,  0.02,   -0.01,   0.004};
  camera.parameters.resize(count);
  camera.r_cam_from_rig = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  camera.t_cam_from_rig_m = {-0.083, 0.001, 0.02};
  return camera;
}

class LensModel : public ::testing::TestWithParam<std::size_t> {};

TEST_P(LensModel, ProjectsByTheFormula) {
  const Camera camera = sample_camera(GetParam());
  const double x = 0.31, y = -0.22, s = x * x + y * y;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;
  if (GetParam() >= 8) k1 = -0.2871, k2 = 0.0902, p1 = 0.00119, p2 = -0.00022;
  if (GetParam() >= 9) k3 = 0.03;
  if (GetParam() >= 12) k4 = 0.02, k5 = -0.01, k6 = 0.004;
  const double radial =
      (1 + k1 * s + k2 * s * s + k3 * s * s * s) / (1 + k4 * s + k5 * s * s + k6 * s * s * s);
  const double xd = x * radial + 2 * p1 * x * y + p2 * (s + 2 * x * x);
  const double yd = y * radial + p1 * (s + 2 * y * y) + 2 * p2 * x * y;
  const auto pixel = project(camera, {2 * x, 2 * y, 2});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 533.83 * xd + 342.5, 1e-11);
  EXPECT_NEAR(pixel->y(), 534.1 * yd + 234.82, 1e-11);
}

TEST_P(LensModel, UnprojectInvertsProjectOverTheImage) {
  const Camera camera = sample_camera(GetParam());
  for (int u = 0; u < 640; u += 71) {
    for (int v = 0; v < 480; v += 53) {
      const auto ray = unproject(camera, Eigen::Vector2d(u, v));
      ASSERT_TRUE(ray) << u << " " << v;
      EXPECT_NEAR(ray->norm(), 1, 1e-15);
      const auto back = project(camera, *ray * 3);
      ASSERT_TRUE(back);
      EXPECT_NEAR(back->x(), u, 1e-9);
      EXPECT_NEAR(back->y(), v, 1e-9);
    }
  }
}

TEST_P(LensModel, DerivativesAgreeWithCentralDifferences) {
  const Camera camera = sample_camera(GetParam());
  const Eigen::Vector3d x(0.12, -0.2, 0.9);
  const auto at = project_with_derivatives(camera, x);
  ASSERT_TRUE(at);
  EXPECT_LT((at->pixel - *project(camera, camera.camera_from_rig(x))).norm(), 1e-10);
  constexpr double h = 1e-6,
                   tolerance = 2e-5;  // h^2 times third derivatives of some 1e3..1e5 px, and rounding / h
  const auto difference = [&](auto change) { return ((change(h) - change(-h)) / (2 * h)).eval(); };
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d d = difference([&](double step) {
      return *project(camera, camera.camera_from_rig(x + step * Eigen::Vector3d::Unit(i)));
    });
    EXPECT_LT((at->by_point.col(i) - d).norm(), tolerance);
  }
  for (int i = 0; i < static_cast<int>(GetParam()); ++i) {
    const Eigen::Vector2d d = difference([&](double step) {
      Camera moved = camera;
      moved.parameters[static_cast<std::size_t>(i)] += step;
      return *project(moved, moved.camera_from_rig(x));
    });
    EXPECT_LT((at->by_parameters.col(i) - d).norm(), tolerance) << i;
  }
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector2d d = difference([&](double step) {
      Camera moved = camera;
      if (i < 3)
        moved.r_cam_from_rig = Eigen::AngleAxisd(step, Eigen::Vector3d::Unit(i)) * camera.r_cam_from_rig;
      else
        moved.t_cam_from_rig_m[i - 3] += step;
      return *project(moved, moved.camera_from_rig(x));
    });
    EXPECT_LT((at->by_pose.col(i) - d).norm(), tolerance) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(AllCounts, LensModel, ::testing::Values(4u, 8u, 9u, 12u));

TEST(Lens, NothingBehindTheCamera) {
  EXPECT_FALSE(project(sample_camera(4), {0, 0, -1}));
  EXPECT_FALSE(project(sample_camera(4), {0, 0, 0}));
}

// r (1 + k1 r^2) turns back where 1 + 3 k1 r^2 = 0.
TEST(Lens, StopsWhereTheDistortionTurnsBack) {
  Camera camera = sample_camera(8);
  camera.parameters = {500, 500, 320, 240, -0.3, 0, 0, 0};
  const double turn = std::sqrt(1 / 0.9);
  EXPECT_TRUE(project(camera, {turn * 0.9999, 0, 1}));
  EXPECT_FALSE(project(camera, {turn * 1.0001, 0, 1}));
  const double largest = turn * (1 - 0.3 * turn * turn);
  EXPECT_TRUE(unproject(camera, {320 + 500 * largest * 0.9999, 240}));
  EXPECT_FALSE(unproject(camera, {320 + 500 * largest * 1.001, 240}));
}

// The denominator 1 + k4 r^2 has a pole at r^2 = -1/k4; beyond it r (1 / D) is monotone again, but with the
// other sign.
TEST(Lens, StopsAtThePoleOfTheRationalModel) {
  Camera camera = sample_camera(12);
  camera.parameters = {500, 500, 320, 240, 0, 0, 0, 0, 0, -2.0, 0, 0};
  EXPECT_TRUE(project(camera, {0.7, 0, 1}));
  EXPECT_FALSE(project(camera, {0.72, 0, 1}));
  EXPECT_FALSE(project(camera, {2, 0, 1}));
}

// Two turning points inside and a positive slope at both ends: only looking along the whole way finds them.
TEST(Lens, FindsADipBetweenTwoGoodEnds) {
  // slope 1 + 3 k1 s + 5 k2 s^2 = (s - 1)^2 - e, positive at 0 and at 2, negative about 1
  const double e = 1e-3;
  const double dips[] = {500, 500, 0, 0, -2.0 / (3 * (1 - e)), 1.0 / (5 * (1 - e)), 0, 0};
  EXPECT_FALSE(brown_conrady::monotone_up_to(dips, 8, 2.0));
  EXPECT_TRUE(brown_conrady::monotone_up_to(dips, 8, 0.9));
  const double touches_not[] = {500, 500, 0, 0, -2.0 / (3 * (1 + e)), 1.0 / (5 * (1 + e)), 0, 0};
  EXPECT_TRUE(brown_conrady::monotone_up_to(touches_not, 8, 2.0));
}

}  // namespace
}  // namespace bpms
