// The choice of the lens model where the truth is known, and on photographs.
#include "calibrate/lens_selection.h"

#include <gtest/gtest.h>

#include "calibrate/adjustment/synthetic.h"
#include "tests/data.h"

namespace bpms {
namespace {

std::string table(const LensSelection& selection) {
  std::string out;
  for (const LensScore& s : selection.scores)
    out += fmt::format("{} {} rms {:.4f} predicts {:.4f} +- {:.4f}, worse by {:.6f} +- {:.6f} {}{}\n", s.lens,
                       s.parameters, s.in_sample_rms_px, s.predicted_rms_px, s.predicted_se_px, s.worse_px2,
                       s.worse_se_px2, s.chosen ? "chosen" : "", s.refused);
  return out;
}

struct KnownLens {
  const char* lens;
  double focal_px, sigma_px;
  int frames;
  std::vector<std::string> candidates;
};
class LensOfKnownTruth : public ::testing::TestWithParam<KnownLens> {};

TEST_P(LensOfKnownTruth, IsChosen) {
  const auto& [lens, focal_px, sigma_px, frames, candidates] = GetParam();
  const SyntheticCalibration scene =
      synthetic_calibration({.cameras = 1, .frames = frames, .lens = lens, .focal_px = focal_px, .seed = 3});
  const LensSelection selection =
      choose_lens(observe(scene, sigma_px, 1), {scene.target}, {.candidates = candidates});
  EXPECT_EQ(selection.chosen, lens) << table(selection);
}

INSTANTIATE_TEST_SUITE_P(
    Truths, LensOfKnownTruth,
    ::testing::Values(KnownLens{"brown4", 535, 0.15, 30, {"brown4", "fisheye", "brown5", "brown8"}},
                      KnownLens{"brown8", 180, 0.05, 40, {"brown4", "brown5", "brown8"}},
                      KnownLens{"fisheye", 240, 0.1, 30, {"brown4", "fisheye", "brown5", "brown8"}},
                      KnownLens{"splined", 535, 0.05, 60, {"brown4", "brown8", "splined"}}));

// 13 frames do not carry more than the short model, whatever their residuals say.
TEST(LensSelectionOnPhotographs, TakesTheShortModel) {
  BPMS_NEED_DATA("calib_ref/corners_sub5.vnl");
  const Observations seen = read_corners(test::data_folder() + "/calib_ref/corners_sub5.vnl", 640, 480, 54);
  const LensSelection selection = choose_lens(seen, {parse_target("chessboard:9x6:25mm")});
  EXPECT_EQ(selection.chosen, "brown4") << table(selection);
}

TEST(LensSelection, NeedsFrames) {
  const SyntheticCalibration scene = synthetic_calibration({.cameras = 1, .frames = 3});
  EXPECT_THROW(choose_lens(observe(scene, 0.1, 1), {scene.target}), Error);
}

}  // namespace
}  // namespace bpms
