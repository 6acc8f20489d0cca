// Normals of a bumped surface against those of the surface that the heights make.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "simulate/materials/bumped_normal.h"

namespace bpms::test {
namespace {

using Eigen::Vector3f;

TEST(Bump, OfAPlaneIsTheNormalOfTheTiltedPlane) {
  // Oblique parameters of the plane z = 0; heights rise by 0.3 a metre along x and fall by 0.2 along y.
  const Vector3f dp_du(2, 0.5f, 0), dp_dv(-0.3f, 1.5f, 0), gradient(0.3f, -0.2f, 0);
  const Vector3f expected = Vector3f(-0.3f, 0.2f, 1).normalized();
  const Eigen::Vector2f slopes(gradient.dot(dp_du), gradient.dot(dp_dv));
  EXPECT_LT((bumped_normal(Vector3f::UnitZ(), dp_du, dp_dv, slopes) - expected).norm(), 1e-6f);
  // U and V the other way round: the same surface.
  EXPECT_LT((bumped_normal(Vector3f::UnitZ(), dp_dv, dp_du, {slopes.y(), slopes.x()}) - expected).norm(),
            1e-6f);
  // Seen along the other normal, heights go down.
  const Vector3f below = bumped_normal(-Vector3f::UnitZ(), dp_du, dp_dv, slopes);
  EXPECT_LT((below - Vector3f(-0.3f, 0.2f, -1).normalized()).norm(), 1e-6f);
}

// A cylinder of radius 2 with ripples along it, differentiated numerically.
TEST(Bump, OfACylinderIsTheNormalOfTheRaisedSurface) {
  const auto height = [](double u, double v) { return 1e-4 * std::sin(40 * u + 7 * v); };
  const auto raised = [&](double u, double v) {
    const double r = 2 + height(u, v);
    return Eigen::Vector3d(r * std::cos(u), r * std::sin(u), 3 * v);
  };
  const double u = 0.7, v = 0.4, step = 1e-5;
  const Eigen::Vector3d exact = (raised(u + step, v) - raised(u - step, v))
                                    .cross(raised(u, v + step) - raised(u, v - step))
                                    .normalized();
  const Vector3f normal = Eigen::Vector3d(std::cos(u), std::sin(u), 0).cast<float>();
  const Vector3f dp_du = Eigen::Vector3d(-2 * std::sin(u), 2 * std::cos(u), 0).cast<float>(), dp_dv(0, 0, 3);
  const Eigen::Vector2f slopes(static_cast<float>((height(u + step, v) - height(u - step, v)) / (2 * step)),
                               static_cast<float>((height(u, v + step) - height(u, v - step)) / (2 * step)));
  // The height itself over the radius, 5e-5 of the slope, is what first order leaves out.
  EXPECT_LT((bumped_normal(normal, dp_du, dp_dv, slopes) - exact.cast<float>()).norm(), 1e-6f);
  EXPECT_GT((normal - exact.cast<float>()).norm(), 1e-4f);
}

TEST(Bump, OfASliverLeavesTheNormal) {
  const Vector3f normal = Vector3f::UnitZ();
  EXPECT_EQ(bumped_normal(normal, Vector3f::UnitX(), 2 * Vector3f::UnitX(), {1, 1}), normal);
  EXPECT_EQ(bumped_normal(normal, Vector3f::Zero(), Vector3f::UnitX(), {1, 1}), normal);
}

}  // namespace
}  // namespace bpms::test
