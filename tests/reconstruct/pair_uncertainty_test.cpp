#include "reconstruct/points/pair_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bpms {
namespace {

constexpr double f = 1000, baseline_m = 0.2, sigma_px = 0.3;

Rig rectified() {
  Rig rig;
  for (const char* name : {"left", "right"}) {
    Camera camera;
    camera.name = name;
    camera.width_px = 1001;
    camera.height_px = 801;
    camera.parameters = {f, f, 500, 400};
    rig.cameras.push_back(camera);
  }
  rig.cameras[1].t_cam_from_rig_m = {-baseline_m, 0, 0};
  return rig;
}

// The covariances are closed forms; what triangulation leaves is rounding, 1e-9 of them.
void expect_close(const Eigen::Vector3d& found, const Eigen::Vector3d& expected) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 1e-9 * expected.norm()) << k;
}

TEST(PairUncertainty, IsTheClosedFormOfARectifiedPair) {
  const auto found = pair_uncertainty(rectified(), 0, 1, sigma_px, {0.8, 2.0});
  ASSERT_EQ(found.size(), 2u);
  for (const PairUncertainty& at : found) {
    const double z = at.range_m, lateral = z * sigma_px / (std::sqrt(2.0) * f);
    expect_close(at.observation_sigma_m,
                 {lateral, lateral, std::sqrt(2.0) * z * z * sigma_px / (f * baseline_m)});
    expect_close(at.sigma_m, at.observation_sigma_m);
  }
}

// A longer baseline moves the points away in proportion and, half of it, aside. A turn of R by r about y, the
// shift t kept, takes the point from (B/2, 0, z) to (B/2 + z r, 0, z - r B/2), before t = (-B, 0, 0): its
// pixel goes by f r (1 - (B/2z)^2), and a pixel error e of one camera moves the point by z^2 e / (f B) in
// depth.
TEST(PairUncertainty, TakesInTheRigsErrors) {
  Rig rig = rectified();
  constexpr double sigma_t_m = 0.0004, sigma_r = 0.0002, z = 1.5;
  rig.covariance = Rig::Covariance{{"right.ry", "right.tx"}, Eigen::MatrixXd::Zero(2, 2), "iid"};
  rig.covariance->matrix.diagonal() << sigma_r * sigma_r, sigma_t_m * sigma_t_m;
  const auto found = pair_uncertainty(rig, 0, 1, sigma_px, {z});
  ASSERT_EQ(found.size(), 1u);
  const Eigen::Vector3d observation = found[0].observation_sigma_m;
  const double by_turn = 1 - std::pow(baseline_m / 2 / z, 2);
  const double depth = z * z / baseline_m * std::hypot(by_turn * sigma_r, sigma_t_m / z);
  const double aside = z / 2 * std::hypot(by_turn * sigma_r, sigma_t_m / z);
  expect_close(found[0].sigma_m,
               {std::hypot(observation.x(), aside), observation.y(), std::hypot(observation.z(), depth)});
}

TEST(PairUncertainty, LeavesOutWhatOneOfThemDoesNotSee) {
  // At 0.1 m the middle of the baseline is at u = 500 +- 1000, outside both images.
  const auto found = pair_uncertainty(rectified(), 0, 1, sigma_px, {0.1, 1.0});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].range_m, 1.0);
}

TEST(PairUncertainty, HasNoAxisWhereCamerasFaceEachOtherOrShareTheirCentre) {
  Rig facing = rectified();
  facing.cameras[1].r_cam_from_rig = Eigen::Vector3d(-1, 1, -1).asDiagonal();
  EXPECT_TRUE(pair_uncertainty(facing, 0, 1, sigma_px, {1.0}).empty());
  Rig one = rectified();
  one.cameras[1].t_cam_from_rig_m.setZero();
  EXPECT_TRUE(pair_uncertainty(one, 0, 1, sigma_px, {1.0}).empty());
}

}  // namespace
}  // namespace bpms
