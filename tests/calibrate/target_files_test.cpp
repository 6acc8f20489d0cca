// Targets as they are written down: on the command line, in board.toml, control_frame.toml and other
// programs' YAML.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/targets/charuco_detector.h"
#include "calibrate/targets/target_kind.h"
#include "tests/calibrate/errors.h"
#include "tests/data.h"

namespace bpms {
namespace {

using ::testing::HasSubstr;

TEST(TargetSpec, EveryKindReadsBackItsFile) {
  for (const char* spec :
       {"chessboard:9x6:25mm", "charuco:11x8:30mm:22mm:DICT_5X5_250",
        "charuco:5x8:30mm:22mm:DICT_4X4_50:legacy", "apriltag:6x4:40mm:10mm", "apriltag:3x2:0.04m:1cm:500",
        "circles:9x6:25mm:13mm", "asymmetric_circles:4x11:20mm:15mm"}) {
    Target target = parse_target(spec);
    for (const bool measured : {false, true}) {
      if (measured) {
        target.measured_m = target.points_m();
        for (auto& x : target.measured_m) x.x() *= 1.001;
      }
      const Target back = parse_board("board.toml", board_toml(target));
      EXPECT_EQ(back.points_m(), target.points_m()) << spec;
      EXPECT_EQ(back.bending(), target.bending()) << spec;
      EXPECT_EQ(board_toml(back), board_toml(target)) << spec;
      EXPECT_EQ(target_kind(back.kind).looks(back), target_kind(target.kind).looks(target)) << spec;
    }
  }
}

TEST(TargetSpec, SaysWhatIsWrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"aprltag:6x4:40mm:10mm", "did you mean 'apriltag'?"},
      {"apriltag:6x4:40mm", "no gap"},
      {"apriltag:6x4:40mm:4mm", "needs a bit"},
      {"apriltag:30x20:40mm:10mm", "the family ends at 586"},
      {"apriltag:6x4:40mm:10mm:587", "first id is 0 to 586"},
      {"apriltag:6x4:40mm:10mm:0:1", "too many parts"},
      {"charuco:11x8:30mm:22mm", "no dictionary"},
      {"charuco:11x8:30mm:22mm:DICT_5X5_205", "did you mean 'DICT_5X5_250'?"},
      {"charuco:11x8:30mm:32mm:DICT_5X5_250", "does not fit"},
      {"charuco:11x10:30mm:22mm:DICT_5X5_50", "DICT_5X5_50 has 50"},
      {"circles:9x6:25mm:24mm", "too wide"},
      {"circles:9:25mm:24mm", "no COLUMNSxROWS"},
      {"control_frame:1", "expected chessboard:"}};
  for (const auto& [spec, part] : cases) BPMS_EXPECT_ERROR(parse_target(spec), ErrorKind::bad_input, part);
}

TEST(TargetSpec, SeveralMustBeToldApart) {
  const auto two = parse_targets({"apriltag:2x2:40mm:10mm", "apriltag:2x2:40mm:10mm:4"});
  EXPECT_EQ(two[0].name, "apriltag");
  EXPECT_EQ(two[1].name, "apriltag 2");
  BPMS_EXPECT_ERROR(parse_targets({"apriltag:2x2:40mm:10mm", "apriltag:2x2:40mm:10mm:3"}),
                    ErrorKind::bad_input, "both show tag 3 of 36h11");
  BPMS_EXPECT_ERROR(parse_targets({"chessboard:9x6:25mm", "chessboard:6x9:20mm"}), ErrorKind::bad_input,
                    "taken for each other");
}

TEST(Charuco, LegacyBoardsBeginWhiteOnAnEvenNumberOfRows) {
  const Target now = parse_target("charuco:5x8:30mm:22mm:DICT_4X4_50"),
               before = parse_target("charuco:5x8:30mm:22mm:DICT_4X4_50:legacy");
  EXPECT_EQ(charuco_marker_id(now, 0, 0), -1);
  EXPECT_EQ(charuco_marker_id(now, 0, 1), 0);
  EXPECT_EQ(charuco_marker_id(now, 1, 0), 2);
  EXPECT_EQ(charuco_marker_id(now, 7, 4), 19);
  EXPECT_EQ(charuco_marker_id(before, 0, 0), 0);
  EXPECT_EQ(charuco_marker_id(before, 1, 1), 3);
  EXPECT_EQ(charuco_marker_id(before, 7, 3), 19);
}

constexpr const char* frame_toml = R"(kind = "control_frame"
name = "bench"
[[tags]]
id = 7
size_m = 0.08
position_m = [1, 2, 3]
quaternion_wxyz = [0.7071067811865476, 0, 0, 0.7071067811865476]
sigma_m = 0.001
[[tags]]
id = 9
size_m = 0.04
position_m = [0, 0, 0]
[[points]]
name = "nail"
position_m = [0, 0, 1]
sigma_m = [0.001, 0.002, 0.003]
[[scale_bars]]
from = "9.0"
to = "nail"
length_m = 1.0005
sigma_m = 0.0001
)";

TEST(ControlFrame, ReadsTagsPointsAndBars) {
  const Target target = parse_board("f.toml", frame_toml);
  EXPECT_TRUE(target.stands);
  ASSERT_EQ(target.size(), 9);
  // A quarter turn about z: the tag's x is the frame's y, its upper left corner (-, -) lands at (+, -).
  EXPECT_TRUE(target.points_m()[0].isApprox(Eigen::Vector3d(1.04, 1.96, 3), 1e-12));
  EXPECT_TRUE(target.points_m()[1].isApprox(Eigen::Vector3d(1.04, 2.04, 3), 1e-12));
  EXPECT_TRUE(target.points_m()[6].isApprox(Eigen::Vector3d(0.02, 0.02, 0), 1e-12));
  EXPECT_EQ(target.point_name(5), "9.1");
  EXPECT_EQ(target.point_name(8), "nail");
  ASSERT_EQ(target.covariance_m2.size(), 9u);
  EXPECT_DOUBLE_EQ(target.covariance_m2[3](1, 1), 1e-6);
  EXPECT_DOUBLE_EQ(target.covariance_m2[4](1, 1), 1e-12);  // as good as exact
  EXPECT_DOUBLE_EQ(target.covariance_m2[8](2, 2), 9e-6);
  ASSERT_EQ(target.scale_bars.size(), 1u);
  EXPECT_EQ(target.scale_bars[0].a, 4);
  EXPECT_EQ(target.scale_bars[0].b, 8);
  for (const auto& b : target.bending()) EXPECT_EQ(b, Eigen::Vector2d(0, 0));

  const Target back = parse_board("f.toml", board_toml(target));
  for (int i = 0; i < 9; ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_TRUE(back.points_m()[k].isApprox(target.points_m()[k], 1e-12));
    EXPECT_TRUE(back.covariance_m2[k].isApprox(target.covariance_m2[k], 1e-12));
  }
  EXPECT_EQ(back.scale_bars[0].b, 8);
}

TEST(ControlFrame, SaysWhatIsWrongAndWhere) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string out = frame_toml;
    return out.replace(out.find(from), from.size(), to);
  };
  const std::pair<std::string, const char*> cases[] = {
      {with("id = 9", "id = 7"), "f.toml:10:6: tags[1].id: tag 7 is there twice"},
      {with("id = 9", "id = 587"), "f.toml:10:6:"},
      {with("0.7071067811865476, 0, 0", "0.9, 0, 0"), "length 1.14"},
      {with("\"9.0\"", "\"9.4\""), "is no point of the frame"},
      {with("1.0005", "1000.5"), "differs from the"},
      {with("[0.001, 0.002, 0.003]", "[0.001, 0, 0.003]"), "standard deviations above 0"},
      {with("size_m = 0.04", "size = 0.04"), "did you mean 'size_m'?"},
      {"kind = \"control_frame\"\n", "neither"}};
  for (const auto& [text, part] : cases)
    BPMS_EXPECT_ERROR(parse_board("f.toml", text), ErrorKind::bad_input, part);
}

TEST(YamlBoards, KalibrAndAprilTagRos) {
  const Target board = parse_board("k.yaml",
                                   "target_type: 'checkerboard' #gridtype\ntargetCols: 6   #corners\n"
                                   "targetRows: 7\nrowSpacingMeters: 0.06\ncolSpacingMeters: 0.06\n");
  EXPECT_EQ(board.kind, "chessboard");
  EXPECT_EQ(board.columns, 6);
  EXPECT_EQ(board.rows, 7);
  EXPECT_DOUBLE_EQ(board.square_m, 0.06);
  const Target oblong = parse_board("k.yaml",
                                    "target_type: checkerboard\ntargetCols: 6\ntargetRows: 7\n"
                                    "rowSpacingMeters: 0.05\ncolSpacingMeters: 0.06\n");
  EXPECT_TRUE(oblong.points_m()[7].isApprox(Eigen::Vector3d(0.06, 0.05, 0), 1e-12));
  EXPECT_EQ(parse_board("k.yaml",
                        "target_type: 'circlegrid'\ntargetCols: 6\ntargetRows: 7\n"
                        "spacingMeters: 0.02\nasymmetricGrid: False\n")
                .kind,
            "circles");
  BPMS_EXPECT_ERROR(parse_board("k.yaml",
                                "target_type: 'aprilgrid'\ntagCols: 6\ntagRows: 6\ntagSize: 0.088\n"
                                "tagSpacing: 0.3\n"),
                    ErrorKind::bad_input,
                    "k.yaml:1:14: target_type: Kalibr's boards of tags cannot be read by AprilTag 3");

  // The first tag is 10 cm to the right of the origin, not turned: its y is up there and down here.
  const Target bundle = parse_board(
      "tags.yaml",
      "standalone_tags:\n  [\n  ]\ntag_bundles:\n  [\n    {\n      name: 'my bundle',\n      layout:\n       "
      " [\n"
      "          {id: 3, size: 0.05, x: 0.1, y: 0.0, z: 0.0, qw: 1.0, qx: 0.0, qy: 0.0, qz: 0.0},\n"
      "          {id: 10, size: 0.15}\n        ]\n    }\n  ]\n");
  EXPECT_EQ(bundle.kind, "control_frame");
  EXPECT_EQ(bundle.name, "my bundle");
  ASSERT_EQ(bundle.size(), 8);
  EXPECT_TRUE(bundle.points_m()[0].isApprox(Eigen::Vector3d(0.075, 0.025, 0), 1e-12));
  EXPECT_TRUE(bundle.points_m()[6].isApprox(Eigen::Vector3d(0.075, -0.075, 0), 1e-12));
}

TEST(MeasuredPoints, MustBeNearTheDesign) {
  const std::string head = "kind = \"apriltag\"\ncolumns = 1\nrows = 1\ntag_m = 0.1\ngap_m = 0.02\n";
  EXPECT_EQ(parse_board("b.toml", head + "points_m = [[0,0,0],[0.1002,0,0],[0.1,0.1,0.001],[0,0.1,0]]\n")
                .points_m()[1],
            Eigen::Vector3d(0.1002, 0, 0));
  BPMS_EXPECT_ERROR(parse_board("b.toml", head + "points_m = [[0,0,0],[0.1,0,0],[0.1,0.1,0]]\n"),
                    ErrorKind::bad_input, "has 3 points, expected the 4 of the board");
  BPMS_EXPECT_ERROR(parse_board("b.toml", head + "points_m = [[0,0,0],[100,0,0],[0.1,0.1,0],[0,0.1,0]]\n"),
                    ErrorKind::bad_input, "lies 99.9 m from where the design has point 1");
}

}  // namespace
}  // namespace bpms
