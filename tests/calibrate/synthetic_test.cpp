// Estimates against a known truth: exact without noise, and with noise as far off as the covariance says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "calibrate/adjustment/synthetic.h"
#include "calibrate/calibrate.h"
#include "tests/calibrate/errors.h"
#include "tests/data.h"

namespace bpms {
namespace {

class NoiseFree : public ::testing::TestWithParam<SyntheticOptions> {};

TEST_P(NoiseFree, FindsTheTruthFromNothing) {
  const SyntheticCalibration scene = synthetic_calibration(GetParam());
  const Calibration c =
      calibrate(observe(scene, 0, 1), scene.target, {.lens = GetParam().lens, .uncertainty = false});
  EXPECT_TRUE(c.converged);
  EXPECT_LT(c.residual_rms_px, 1e-9);
  EXPECT_EQ(c.corners_used, c.corners_total);
  const Eigen::VectorXd off = test::errors(c.rig.cameras, scene.truth.cameras);
  // 1e-9 px of residual are magnified by the conditioning, most for the higher coefficients of the rational
  // model.
  const double tolerance = GetParam().lens == "brown8" ? 1e-4 : 1e-7;
  for (Eigen::Index i = 0; i < off.size(); ++i)
    EXPECT_LT(std::abs(off[i]), tolerance) << c.rig.covariance->order[static_cast<std::size_t>(i)];
  EXPECT_LT((c.targets[0].warp_m - scene.truth.bending_m[0]).norm(), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Rigs, NoiseFree,
                         ::testing::Values(SyntheticOptions{}, SyntheticOptions{.cameras = 1},
                                           SyntheticOptions{.cameras = 3}, SyntheticOptions{.lens = "brown5"},
                                           SyntheticOptions{.lens = "brown8", .focal_px = 280},
                                           SyntheticOptions{.frames = 4, .seed = 5}));

// A board that bends otherwise in each frame makes corners err together; iid sigmas do not see that.
TEST(Clustered, SeesErrorsThatFramesShare) {
  SyntheticCalibration scene = synthetic_calibration({.frames = 13, .bending_m = {0, 0}, .seed = 11});
  Observations together = observe(scene, 0.02, 1);
  for (std::size_t f = 0; f < scene.truth.world_from_target[0].size(); ++f) {
    SyntheticCalibration bent = scene;
    bent.truth.bending_m[0] = Eigen::Vector2d(f % 2 ? 1 : -1, f % 3 ? 0.5 : -1) * 0.4e-3;
    const Observations there = observe(bent, 0.02, 1);
    for (std::size_t v = 0; v < together.views.size(); ++v) {
      if (together.views[v].frame == fmt::format("{:02}", f + 1)) together.views[v] = there.views[v];
    }
  }
  const Calibration c = calibrate(together, scene.target);
  ASSERT_TRUE(c.pairs[0].baseline_sigma_clustered_m);
  EXPECT_GT(std::sqrt(c.sigma_clustered.cwiseQuotient(c.sigma_iid).cwiseAbs2().mean()), 2.5);
}

TEST(Outliers, AreNamedAndDoNotCount) {
  const SyntheticCalibration scene = synthetic_calibration({});
  Observations observations = observe(scene, 0.15, 4);
  const Calibration clean = calibrate(observations, scene.target, {.uncertainty = false});
  EXPECT_TRUE(clean.outliers.empty());
  std::set<std::pair<std::string, int>> spoilt;
  for (std::size_t v = 0; v < observations.views.size(); ++v) {
    for (const int i :
         {static_cast<int>(v * 7 % 54), static_cast<int>((v * 11 + 20) % 54)}) {  // 4 % of the corners
      auto& corner = observations.views[v].corners[static_cast<std::size_t>(i)];
      corner.pixel += Eigen::Vector2d(v % 2 ? 3.0 : -12.0, v % 3 ? 5.0 : -20.0);
      spoilt.emplace(observations.views[v].image, i);
    }
  }
  const Calibration c = calibrate(observations, scene.target, {.uncertainty = false});
  std::set<std::pair<std::string, int>> named;
  for (const auto& o : c.outliers) {
    named.emplace(o.image, o.corner);
    EXPECT_GT(o.residual_px, 2);
  }
  EXPECT_EQ(named, spoilt);
  // What is left is 96 % of the clean corners: the estimate moves by about sqrt(0.04) of its sigma.
  EXPECT_LT(std::abs(c.pairs[0].baseline_m - clean.pairs[0].baseline_m),
            0.8 * clean.pairs[0].baseline_sigma_m);
  EXPECT_NEAR(c.residual_sigma_px, 0.15, 4 * 0.15 / std::sqrt(2.0 * c.degrees_of_freedom));
}

TEST(Outliers, AScrambledViewIsLeftOutAsAWhole) {
  const SyntheticCalibration scene = synthetic_calibration({});
  Observations observations = observe(scene, 0.15, 4);
  for (ImageCorner& corner : observations.views[5].corners) corner.point = corner.point * 7 % 54;
  const Calibration c = calibrate(observations, scene.target, {.uncertainty = false});
  for (std::size_t v = 0; v < c.views.size(); ++v) EXPECT_EQ(c.views[v].outlier, v == 5) << c.views[v].image;
  EXPECT_THAT(c.views[5].reason, ::testing::HasSubstr("54 of 54"));
  EXPECT_EQ(c.corners_used, c.corners_total - 54);
  EXPECT_NEAR(c.residual_sigma_px, 0.15, 4 * 0.15 / std::sqrt(2.0 * c.degrees_of_freedom));
}

// A board turned by half in one view of a frame fits by itself: which of the two views is wrong nobody can
// say, but one is left out and the rest is untouched.
TEST(Outliers, AViewTurnedByHalfIsSetApartFromItsPartner) {
  const SyntheticCalibration scene = synthetic_calibration({});
  Observations observations = observe(scene, 0.15, 4);
  for (ImageCorner& corner : observations.views[5].corners) corner.point = 53 - corner.point;
  const Calibration c = calibrate(observations, scene.target, {.uncertainty = false});
  int out = 0;
  for (const auto& view : c.views) {
    if (!view.outlier) continue;
    EXPECT_EQ(view.frame, "06");
    ++out;
  }
  EXPECT_EQ(out, 1);
  EXPECT_EQ(c.corners_used, c.corners_total - 54);
  EXPECT_NEAR(c.residual_sigma_px, 0.15, 4 * 0.15 / std::sqrt(2.0 * c.degrees_of_freedom));
}

TEST(Calibrate, RefusesWhatCannotBeSolved) {
  const SyntheticCalibration scene = synthetic_calibration({.frames = 4});
  const Observations good = observe(scene, 0.1, 1);
  Observations two = good;
  std::erase_if(two.views, [](const BoardView& v) { return v.frame > "02" && v.camera == 1; });
  BPMS_EXPECT_ERROR(calibrate(two, scene.target), ErrorKind::bad_input,
                    "camera 'cameraB' has 2 usable views");
  BPMS_EXPECT_ERROR(calibrate({}, scene.target), ErrorKind::bad_input, "no usable view");
  Observations apart = good;
  for (BoardView& view : apart.views) view.frame += view.camera == 1 ? "1" : "";
  BPMS_EXPECT_ERROR(calibrate(apart, scene.target), ErrorKind::bad_input, "shares no frame");
}

// Boards square to the axis leave the focal length open.
TEST(Calibrate, SaysWhatTheViewsDoNotDetermine) {
  SyntheticCalibration scene = synthetic_calibration({.cameras = 1, .frames = 6});
  for (std::size_t f = 0; f < 6; ++f)
    scene.truth.world_from_target[0][f] = {Eigen::Matrix3d::Identity(), {-0.1, -0.06, 0.5}};
  BPMS_EXPECT_ERROR(calibrate(observe(scene, 0, 1), scene.target), ErrorKind::numeric, "do not determine");
  // Parallel boards at several distances, with noise: a number comes out, and it is not believed.
  for (std::size_t f = 0; f < 6; ++f)
    scene.truth.world_from_target[0][f].t_m = {-0.1, -0.06, 0.4 + 0.05 * static_cast<double>(f)};
  for (std::uint64_t seed = 1; seed < 6; ++seed)
    BPMS_EXPECT_ERROR(calibrate(observe(scene, 0.1, seed), scene.target), ErrorKind::numeric, "cameraA.f");
}

// The size of a square is an error that no residual shows; a bar that was measured by itself does.
TEST(Calibrate, SaysByHowMuchAScaleBarContradicts) {
  SyntheticCalibration scene = synthetic_calibration({.cameras = 1});
  scene.target.scale_bars = {{0, 8, 8 * 0.0255, 1e-4}};
  BPMS_EXPECT_ERROR(calibrate(observe(scene, 0.1, 1), scene.target), ErrorKind::bad_input,
                    "1.02 times as large as given");
  scene.target.scale_bars = {{0, 8, 8 * 0.025 + 2e-4, 1e-4}};
  EXPECT_TRUE(calibrate(observe(scene, 0.1, 1), scene.target, {.uncertainty = false}).converged);
}

}  // namespace
}  // namespace bpms
