// OpenCV's sample pairs (13 frames, 9x6 board of 25 mm): the figures that other programs and a reference
// solution gave.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "calibrate/calibrate.h"
#include "calibrate/images/find_corners.h"
#include "tests/data.h"

namespace bpms {
namespace {

const Target& board() {
  static const Target target = parse_target("chessboard:9x6:25mm");
  return target;
}
Observations corners(const std::string& name) {
  return read_corners(test::data_folder() + "/calib_ref/" + name, 640, 480, 54);
}

// Two jackknife standard deviations never pass: the difference of the half sets is of the size that they
// predict.
void expect_half_sets_agree(const Calibration& c) {
  ASSERT_TRUE(c.half_sets);
  EXPECT_LT(std::abs(c.half_sets->odd_baseline_m - c.half_sets->even_baseline_m),
            2.6 * c.half_sets->sigma_clustered_m);
}

TEST(SampleSet, ReferenceCornersGiveTheReferenceSolution) {
  BPMS_NEED_DATA("calib_ref/corners_sub5.vnl");
  const Calibration c = calibrate(corners("corners_sub5.vnl"), board());
  EXPECT_NEAR(c.pairs[0].baseline_m, 83.168e-3, 0.02e-3);
  EXPECT_NEAR(c.rig.cameras[0].parameters[0], 533.83, 0.1);
  EXPECT_NEAR(c.rig.cameras[1].parameters[0], 537.21, 0.1);
  EXPECT_NEAR(c.residual_rms_px, 0.147, 0.001);
  EXPECT_NEAR(c.residual_sigma_px, 0.150, 0.001);
  EXPECT_EQ(c.corners_used, 1404);
  EXPECT_NEAR(c.targets[0].warp_m.x(), 0.022e-3, 0.001e-3);
  EXPECT_NEAR(c.targets[0].warp_m.y(), -0.172e-3, 0.001e-3);
  // Reference uncertainties: iid 0.043, jackknife by frame 0.132 mm; fx 0.32 and 1.04 px.
  EXPECT_NEAR(c.pairs[0].baseline_sigma_m, 0.043e-3, 0.001e-3);
  EXPECT_NEAR(c.pairs[0].baseline_sigma_clustered_m.value(), 0.132e-3, 0.002e-3);
  EXPECT_NEAR(c.sigma_iid[0], 0.32, 0.01);
  EXPECT_NEAR(c.sigma_clustered[0], 1.04, 0.02);
  for (const auto& view : c.views) EXPECT_FALSE(view.outlier) << view.image;
  expect_half_sets_agree(c);
  std::printf("solve %.3f s, uncertainty %.3f s\n", c.solve_seconds, c.uncertainty_seconds);
}

TEST(SampleSet, AFlatBoardGivesWhatOpenCvFinds) {
  BPMS_NEED_DATA("calib_ref/corners_sub5.vnl");
  const Calibration c =
      calibrate(corners("corners_sub5.vnl"), board(), {.board_warp = false, .uncertainty = false});
  EXPECT_NEAR(c.pairs[0].baseline_m, 83.183e-3, 0.001e-3);
  EXPECT_NEAR(c.residual_rms_px, 0.1522, 0.0001);  // OpenCV's 0.2153 px a corner over sqrt(2)
  EXPECT_EQ(c.targets[0].warp_m, Eigen::Vector2d::Zero());
}

TEST(SampleSet, BadCornersAreFoundAndNamed) {
  BPMS_NEED_DATA("calib_ref/corners_sub11.vnl");
  const Calibration c = calibrate(corners("corners_sub11.vnl"), board(), {.uncertainty = false});
  EXPECT_NEAR(c.pairs[0].baseline_m, 83.17e-3, 0.05e-3);
  for (const auto& view : c.views)
    EXPECT_EQ(view.outlier, view.frame == "02") << view.image << " " << view.reason;
  EXPECT_LT(c.outliers.size(), 45u);
}

TEST(SampleSet, OurCornersAreAsGood) {
  BPMS_NEED_DATA("opencv-doc/left01.jpg");
  const std::string folder = test::data_folder() + "/opencv-doc/";
  const auto files = expand_patterns({folder + "left[0-9]*.jpg", folder + "right[0-9]*.jpg"});
  ASSERT_EQ(files.size(), 26u);
  const Observations observations = find_corners(files, board());
  EXPECT_TRUE(observations.skipped.empty());
  const Calibration c = calibrate(observations, board());
  EXPECT_EQ(c.corners_used, 1404);
  EXPECT_EQ(c.corners_total, 1404);
  EXPECT_LE(c.residual_rms_px, 0.150);
  EXPECT_NEAR(c.pairs[0].baseline_m, 83.168e-3, 0.05e-3);
  expect_half_sets_agree(c);
}

// The rational model has more coefficients than these views determine: a solution that is sound over the
// whole image and fits no worse than the short model, or a refusal that says why; never numbers in between.
TEST(SampleSet, TheRationalModelConvergesOrIsRefused) {
  BPMS_NEED_DATA("calib_ref/corners_sub5.vnl");
  for (const char* name : {"corners_sub5.vnl", "corners_sub11.vnl"}) {
    try {
      const Calibration c = calibrate(corners(name), board(), {.lens = "brown8", .uncertainty = false});
      EXPECT_LT(c.residual_rms_px, 0.15);
      EXPECT_NEAR(c.pairs[0].baseline_m, 83.17e-3, 0.1e-3);
      for (const Camera& camera : c.rig.cameras) EXPECT_FALSE(pixel_without_ray(camera));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::numeric);
      EXPECT_THAT(error.what(), ::testing::AnyOf(::testing::HasSubstr("folds or has a pole"),
                                                 ::testing::HasSubstr("do not determine"),
                                                 ::testing::HasSubstr("did not converge")));
    }
  }
}

TEST(SampleSet, FifthOrderAgrees) {
  BPMS_NEED_DATA("calib_ref/corners_sub5.vnl");
  const Calibration c =
      calibrate(corners("corners_sub5.vnl"), board(), {.lens = "brown5", .uncertainty = false});
  EXPECT_NEAR(c.pairs[0].baseline_m, 83.166e-3, 0.002e-3);
  EXPECT_NEAR(c.residual_rms_px, 0.1468, 0.0001);
}

}  // namespace
}  // namespace bpms
