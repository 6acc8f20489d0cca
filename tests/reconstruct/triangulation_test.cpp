#include "reconstruct/points/triangulation.h"

#include <gtest/gtest.h>

#include "tests/reconstruct/synthetic.h"

namespace bpms {
namespace {

TEST(Triangulation, IsExactWithoutNoise) {
  Philox random(1);
  for (const Rig& rig : {test::parallel_rig(), test::convergent_rig(2), test::convergent_rig(3)}) {
    for (int trial = 0; trial < 50; ++trial) {
      const Eigen::Vector3d x = test::somewhere(random);
      const Triangulation found = triangulate(test::sight(rig, x, 0.5, nullptr), rig);
      ASSERT_EQ(found.failure, "");
      EXPECT_LT((found.x_m - x).norm(), 1e-11);
      EXPECT_LT(found.residual.cwiseAbs().maxCoeff(), 1e-8);
    }
  }
}

TEST(Triangulation, NoShorterSumOfSquaresNearby) {
  const Rig rig = test::convergent_rig(3);
  Philox random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const auto sightings = test::sight(rig, test::somewhere(random), 2.0, &random);
    const Triangulation found = triangulate(sightings, rig);
    ASSERT_EQ(found.failure, "");
    const auto squares = [&](const Eigen::Vector3d& x) {
      double sum = 0;
      for (const Sighting& s : sightings) {
        const Camera& c = rig.cameras[static_cast<std::size_t>(s.camera)];
        sum += (s.pixel - project(c, c.camera_from_rig(x)).value()).squaredNorm() / (s.sigma_px * s.sigma_px);
      }
      return sum;
    };
    const Eigen::Matrix3d l = found.covariance_m2.llt().matrixL();
    for (int k = 0; k < 6; ++k) {
      const Eigen::Vector3d step = (k % 2 == 0 ? 0.01 : -0.01) * l.col(k / 2);
      // At a minimum a step of 0.01 standard errors costs 1e-4, up to the residuals' curvature.
      EXPECT_NEAR(squares(found.x_m + step) - squares(found.x_m), 1e-4, 1e-5);
    }
  }
}

TEST(Triangulation, TheOrderOfTheCamerasDoesNotMatter) {
  const Rig rig = test::convergent_rig(3);
  Rig reversed = rig;
  std::reverse(reversed.cameras.begin(), reversed.cameras.end());
  Philox random(3);
  for (int trial = 0; trial < 20; ++trial) {
    auto sightings = test::sight(rig, test::somewhere(random), 0.5, &random);
    const Triangulation a = triangulate(sightings, rig);
    for (Sighting& s : sightings) s.camera = 2 - s.camera;
    std::reverse(sightings.begin(), sightings.end());
    const Triangulation b = triangulate(sightings, reversed);
    const double sigma = std::sqrt(a.covariance_m2.trace());
    EXPECT_LT((a.x_m - b.x_m).norm(), 1e-7 * sigma);
    EXPECT_LT((a.covariance_m2 - b.covariance_m2).norm(), 1e-7 * a.covariance_m2.norm());
  }
}

TEST(Triangulation, SaysWhatIsWrong) {
  const Rig rig = test::parallel_rig();
  const auto reason = [&](const Eigen::Vector2d& left, const Eigen::Vector2d& right) {
    return triangulate({{0, left, 0.5}, {1, right, 0.5}}, rig).failure;
  };
  EXPECT_EQ(triangulate({{0, {800, 600}, 0.5}}, rig).failure, "seen in one image only");
  EXPECT_EQ(reason({800, 600}, {800, 600}), "parallel rays");    // at infinity
  EXPECT_EQ(reason({801, 600}, {800, 600}), "parallel rays");    // 1 px of parallax, 0.7 px of sigma
  EXPECT_EQ(reason({800, 600}, {801, 600}), "parallel rays");    // beyond infinity, within the errors
  EXPECT_EQ(reason({700, 600}, {900, 600}), "behind a camera");  // rays diverge
  EXPECT_EQ(reason({1200, 600}, {400, 600}), "");                // Z = 3500 * 0.3 / 800
  EXPECT_EQ(reason({800, 620}, {800, 580}), "parallel rays");    // apart across the baseline only

  Rig strong = rig;  // barrel distortion that folds over inside the image
  for (Camera& c : strong.cameras) c.parameters = {900, 900, 800, 600, -0.6, 0, 0, 0};
  EXPECT_EQ(triangulate({{0, {1600, 600}, 0.5}, {1, {1500, 600}, 0.5}}, strong).failure,
            "outside the lens model");
}

}  // namespace
}  // namespace bpms
