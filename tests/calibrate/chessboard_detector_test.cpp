// The detector on rendered boards, whose corners are known exactly, and on the ways in which real sets are
// incomplete.
#include "calibrate/targets/chessboard_detector.h"
#include "calibrate/images/find_corners.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/calibrate/rendered_board.h"
#include "tests/data.h"

namespace bpms {
namespace {

using test::look_at, test::render;

Target make_target(int columns, int rows) {
  Target target;
  target.columns = columns, target.rows = rows, target.square_m = 0.02;
  return target;
}

class Rendered : public ::testing::TestWithParam<double> {};
TEST_P(Rendered, CornersAreWhereTheyWereDrawnAndInTheBoardsOrder) {
  const Target target = make_target(9, 6);
  const test::BoardPose view = look_at(target, GetParam(), 30);
  const auto corners = find_chessboard(render(target, view), target);
  ASSERT_TRUE(corners);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double square = 0;
  for (std::size_t i = 0; i < corners->size(); ++i) {
    const Eigen::Vector2d off = (*corners)[i] - test::pixel(view, target.points_m()[i]);
    mean += off / 54;
    square += off.squaredNorm() / 54;
  }
  EXPECT_LT(mean.norm(), 0.02);  // a convention of half pixels would give 0.7
  EXPECT_LT(std::sqrt(square / 2), 0.04);
}
// Any roll: the colours of a 9x6 board tell its ends apart.
INSTANTIATE_TEST_SUITE_P(Rolls, Rendered, ::testing::Values(0.0, 30.0, 90.0, 180.0, 250.0));

TEST(Detector, CamerasOfAFrameAgreeOnABoardThatHalfATurnLeavesAlike) {
  const test::TemporaryFolder folder;
  const Target target = make_target(8, 6);
  std::vector<std::string> files;
  for (const auto& [name, roll] :
       {std::pair{"left1.png", 2.0}, {"right1.png", -60.0}, {"left2.png", 178.0}, {"right2.png", 122.0}}) {
    files.push_back(folder / name);
    cv::imwrite(files.back(), render(target, look_at(target, roll, 25)));
  }
  const Observations found = find_corners(files, target);
  ASSERT_EQ(found.views.size(), 4u);
  for (const std::size_t v : {0u, 2u}) {
    const BoardView &left = found.views[v], &right = found.views[v + 1];
    ASSERT_EQ(left.frame, right.frame);
    Eigen::Vector2d along[2];
    for (int c = 0; c < 2; ++c) {
      const BoardView& view = c ? right : left;
      for (const ImageCorner& corner : view.corners) {
        if (corner.point == 0) along[c] -= corner.pixel;
        if (corner.point == 7) along[c] += corner.pixel;
      }
    }
    // In both the row runs from the same end: 62 degrees apart as drawn, not 118.
    EXPECT_GT(along[0].normalized().dot(along[1].normalized()), 0.2);
  }
}

TEST(Detector, NamesWhatItSkips) {
  const test::TemporaryFolder folder;
  const Target target = make_target(9, 6);
  for (int i = 1; i <= 3; ++i)
    cv::imwrite(folder / fmt::format("left{}.png", i), render(target, look_at(target, 0, 10 * i)));
  cv::imwrite(folder / "left4.png",
              cv::Mat(test::board_image_height, test::board_image_width, CV_8U, cv::Scalar(90)));
  cv::Mat small;
  cv::resize(render(target, look_at(target, 0, 20)), small, cv::Size(320, 240));
  cv::imwrite(folder / "left5.png", small);
  folder.write("left6.png", "no image");
  const std::vector<std::string> files = expand_patterns(
      {folder / "left[0-9].png", folder / "left7.png", folder / "up*.png", folder / "left.png"});
  ASSERT_EQ(files.size(), 9u);
  const Observations found = find_corners(files, target);
  EXPECT_EQ(found.views.size(), 3u);
  ASSERT_EQ(found.skipped.size(), 6u);
  const char* const reasons[] = {
      "no whole 9x6 chessboard", "320x240 pixels",       "cannot be read as an image", "no such file",
      "no file matches",         "no digits in the name"};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_THAT(found.skipped[i].reason, ::testing::HasSubstr(reasons[i]));
}

TEST(Detector, RefusesTwoImagesOfOneMoment) {
  const test::TemporaryFolder folder;
  const Target target = make_target(9, 6);
  for (const char* name : {"left1.png", "left1.bmp"})
    cv::imwrite(folder / name, render(target, look_at(target, 0, 20)));
  BPMS_EXPECT_ERROR(find_corners({folder / "left1.png", folder / "left1.bmp"}, target), ErrorKind::bad_input,
                    "second image of frame 1");
}

}  // namespace
}  // namespace bpms
