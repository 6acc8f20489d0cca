#include "calibrate/observations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/targets/target.h"
#include "core/error.h"
#include "tests/data.h"

namespace bpms {
namespace {

TEST(ImageName, IsCameraAndFrame) {
  const std::tuple<const char*, const char*, const char*> cases[] = {
      {"left01.jpg", "left", "01"},
      {"/a/b7/right14.png", "right", "14"},
      {"cam0_frame12.png", "cam0_frame", "12"},
      {"3_top.tif", "top", "3"},
      {"left/007.png", "left", "007"},
      {"12.png", "camera", "12"},
  };
  for (const auto& [path, camera, frame] : cases) {
    const ImageName name = parse_image_name(path);
    EXPECT_EQ(name.camera, camera) << path;
    EXPECT_EQ(name.frame, frame) << path;
  }
  BPMS_EXPECT_ERROR(parse_image_name("left.jpg"), ErrorKind::bad_input, "no digits in the name");
}

TEST(Corners, AreReadRowByRow) {
  const test::TemporaryFolder folder;
  const std::string path =
      folder.write("c.vnl",
                   "# filename x y level\nleft1.png 10 20.5 0\nleft1.png - - -\nright1.png 1 2 0\n"
                   "right1.png 3 4 1\nleft2.png - - -\nleft2.png 1 1 -\n");
  const Observations out = read_corners(path, 640, 480, 2);
  ASSERT_EQ(out.cameras.size(), 2u);
  EXPECT_EQ(out.cameras[1].name, "right");
  EXPECT_EQ(out.cameras[1].width_px, 640);
  ASSERT_EQ(out.views.size(), 2u);
  ASSERT_EQ(out.views[0].corners.size(), 1u);
  EXPECT_EQ(out.views[0].corners[0].point, 0);
  EXPECT_EQ(out.views[0].corners[0].pixel, Eigen::Vector2d(10, 20.5));
  EXPECT_EQ(out.views[1].corners[1].point, 1);
  ASSERT_EQ(out.skipped.size(), 1u);
  EXPECT_EQ(out.skipped[0].image, "left2.png");
}

TEST(Corners, ErrorsAreLocated) {
  const test::TemporaryFolder folder;
  const std::tuple<const char*, const char*> cases[] = {
      {"a1.png 1 2 0\n", "c.vnl:2:1: a1.png has 1 corners, the target has 2"},
      {"a1.png 1 2 0\na1.png 1 2 0\na1.png 1 2 0\n", "c.vnl:3:1: 'a1.png' has more corners"},
      {"a1.png 1 2 0\nb1.png 1 2 0\n", "c.vnl:2:1: a1.png has 1 corners"},
      {"a1.png 1 x 0\n", "c.vnl:1:10: 'x'; expected a coordinate"},
      {"a1.png 1 nan 0\n", "c.vnl:1:10"},
      {"a1.png 1 2 good\n", "c.vnl:1:12: level 'good'"},
      {"a1.png 1 2\n", "expected four fields"},
      {"a1.png 1 2\na1.png 3 4\n", "c.vnl:1:1: expected four fields"},
      {"a1.png 640 2 0\n", "c.vnl:1:8: 640 lies outside the 640x480 image"},
      {"a1.png 1 -1 0\n", "outside"},
      {"a1.png 1 2 0\na1.png 1 2 0\na2.png 1 2 0\na2.png 1 2 0\na1.png 1 2 0\n",
       "c.vnl:5:1: corners of 'a1.png' appear in two places"},
      {"a1.png 1 2 0\na1.png 1 2 0\na1.jpg 1 2 0\n", "both frame 1 of camera a"},
      {"left.png 1 2 0\n", "no digits"},
  };
  for (const auto& [text, message] : cases) {
    const std::string path = folder.write("c.vnl", text);
    BPMS_EXPECT_ERROR(read_corners(path, 640, 480, 2), ErrorKind::bad_input, message);
  }
}

TEST(Target, IsParsedFromItsShortForm) {
  const Target target = parse_target("chessboard:9x6:25mm");
  EXPECT_EQ(target.columns, 9);
  EXPECT_EQ(target.rows, 6);
  EXPECT_DOUBLE_EQ(target.square_m, 0.025);
  EXPECT_EQ(target.points_m()[10], Eigen::Vector3d(0.025, 0.025, 0));
  EXPECT_EQ(target.bending()[0], Eigen::Vector2d(0, 0));
  EXPECT_DOUBLE_EQ(target.bending()[4].x(), 1);
  for (const char* bad : {"chessboard", "chessboard:9x6", "chessboard:9:25mm", "chessboard:9x6:25",
                          "chessboard:2x6:25mm", "chessboard:9x600:25mm", "chessboard:9x6:0mm",
                          "chessboard:9x6:-2mm", "chessboard:ax6:2mm", "circles:4x4:2mm"})
    BPMS_EXPECT_ERROR(parse_target(bad), ErrorKind::bad_input, "target");
}

TEST(Target, ReadsBackItsFile) {
  const test::TemporaryFolder folder;
  const Target target = parse_target("chessboard:11x8:0.3in");
  const Target back = parse_target(folder.write("board.toml", board_toml(target)));
  EXPECT_EQ(back.points_m(), target.points_m());
  BPMS_EXPECT_ERROR(
      read_board(folder.write("b.toml", "kind = \"charucco\"\ncolumns = 5\nrows = 7\nsquare_m = 0.1\n")),
      ErrorKind::bad_input, "did you mean 'charuco'?");
  BPMS_EXPECT_ERROR(read_board(folder.write("b.toml", board_toml(target) + "colour = 1\n")),
                    ErrorKind::bad_input, "b.toml:5:");
}

}  // namespace
}  // namespace bpms
