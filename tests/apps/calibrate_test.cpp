// Corners, targets and photographs that no calibration comes from, and those that it goes on without.
#include <gmock/gmock.h>

#include "core/json.h"
#include "tests/apps/refused.h"
#include "tests/command.h"

namespace bpms::test {
namespace {

using ::testing::HasSubstr;

Refusal corners(const std::string& name, const Edit& spoil, const std::string& begin,
                const std::vector<std::string>& holds = {}, int code = 2) {
  return {name, spoil, calibrate_corners, code, begin, holds};
}
Refusal option(const std::string& name, const std::string& arguments, const std::string& begin,
               const std::vector<std::string>& holds = {}, int code = 2) {
  return {name, as_it_is(), "calibrate " + arguments + " -o new.toml", code, begin, holds};
}
Refusal images(const std::string& name, const Edit& spoil, const std::string& begin,
               const std::vector<std::string>& holds = {}, int code = 2) {
  return {name, spoil, calibrate_images, code, begin, holds};
}
Edit first_corner(const std::string& row) {  // in the place of the table
  return written("corners.vnl", "# filename x y level\n" + row);
}

INSTANTIATE_TEST_SUITE_P(
    Corners, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        corners("Truncated", first_corner("a01.png 1 2 0\na01.png 3 4 0\n"),
                "corners.vnl:", {"2 corners, the target has 54"}),
        corners("TruncatedRow", first_corner("a01.png 1 2"), "corners.vnl:2:1: ", {"four fields"}),
        corners("NotANumber", first_corner("a01.png nan 2 0\n"),
                "corners.vnl:2:9: ", {"'nan'", "coordinate in pixels"}),
        corners("HugeNumber", first_corner("a01.png 1e30 2 0\n"),
                "corners.vnl:2:9: ", {"outside the 640x480 image"}),
        corners("OutsideTheImage", first_corner("a01.png 1 480 0\n"),
                "corners.vnl:2:11: ", {"480", "outside the 640x480 image"}),
        corners("UnknownLevel", first_corner("a01.png 1 2 good\n"), "corners.vnl:2:13: ", {"'good'"}),
        corners("NoFrameInTheName", first_corner("left.png 1 2 0\n"), "corners.vnl:2:1: ", {"no digits"}),
        corners("OnlyAHeader", first_corner(""), "corners.vnl: ", {"no corners"}),
        corners("FewerThanThreeViews", cut_before("corners.vnl", "cameraA03"), "",
                {"camera 'cameraA' has 2 usable views", "at least 3"}),
        option("NoSize", "--corners corners.vnl --target chessboard:9x6:25mm", "", {"--image-size"}),
        option("SizeOfWords", "--corners corners.vnl --image-size vga --target chessboard:9x6:25mm", "",
               {"'vga'", "640x480"}),
        option("ZeroSize", "--corners corners.vnl --image-size 0x480 --target chessboard:9x6:25mm", "",
               {"'0x480'"}),
        option("SquareWithoutUnit", "--corners corners.vnl --image-size 640x480 --target chessboard:9x6:25",
               "--target", {"no unit"}),
        option("SquareOfAnUnknownUnit",
               "--corners corners.vnl --image-size 640x480 --target chessboard:9x6:25ft", "--target",
               {"'ft'"}),
        option("ZeroSquare", "--corners corners.vnl --image-size 640x480 --target chessboard:9x6:0mm",
               "--target", {"no size"}),
        option("NegativeSquare", "--corners corners.vnl --image-size 640x480 --target chessboard:9x6:-2mm",
               "--target", {}),
        option("OtherTarget", "--corners corners.vnl --image-size 640x480 --target chessboard:8x6:25mm",
               "corners.vnl:", {"48"}),
        option("UnknownTarget", "--corners corners.vnl --image-size 640x480 --target chesboard:9x6:25mm",
               "--target", {"chessboard:"}),
        option("UnknownModel",
               "--corners corners.vnl --image-size 640x480 --target chessboard:9x6:25mm --model brown6",
               "--model", {"'brown6'", "brown4"}),
        option("ImagesAndCorners",
               "--corners corners.vnl --images a1.png --image-size 640x480 --target chessboard:9x6:25mm", "",
               {"exclude"}),
        option("NothingGiven", "--target chessboard:9x6:25mm", "", {"--images or --corners"})}),
    name_of_case);

const std::string with_board =
    "calibrate --corners corners.vnl --image-size 640x480 --target board.toml -o new.toml";
Refusal board(const std::string& name, const std::string& what, const std::string& by,
              const std::string& begin, const std::vector<std::string>& holds) {
  return {name, replaced("board.toml", what, by), with_board, 2, "board.toml:" + begin, holds};
}
INSTANTIATE_TEST_SUITE_P(
    Board, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        board("ZeroSquare", "0.025", "0", "4:12: ", {"square_m", "above 0"}),
        board("NotANumber", "0.025", "nan", "4:12: ", {"finite"}),
        board("Millimetres", "square_m ", "square_mm ", "4:1: ", {"'square_mm'", "did you mean 'square_m'?"}),
        board("HugeSquare", "0.025", "1e14", "4:12: ", {"square_m"}),
        board("NegativeColumns", "9", "-9", "2:11: ", {"columns"}),
        board("UnknownKind", "\"chessboard\"", "\"chesboard\"", "1:8: ", {"did you mean 'chessboard'?"})}),
    name_of_case);

// One camera, three images at least.
Edit two_boards_and(const std::string& file, const std::string& content) {
  return both(board_images(2), written(file, content));
}
INSTANTIATE_TEST_SUITE_P(
    Images, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        images("NoneMatches", as_it_is(), "", {"no usable view", "left[0-9].png", "no file matches"}),
        images("NoBoardInAny", both(blank_image("left1.png", 64, 48), blank_image("left2.png", 64, 48)), "",
               {"no usable view", "left1.png", "chessboard"}),
        images("TwoUsable", both(board_images(2), blank_image("left3.png", 640, 480)), "",
               {"'left' has 2 usable views", "at least 3",
                "skipped left3.png: no whole 9x6 chessboard found"}),
        images("TwoUsableAndOneOfAnotherSize", both(board_images(2), blank_image("left3.png", 320, 240)), "",
               {"2 usable views", "skipped left3.png: 320x240 pixels"}),
        images("TwoUsableAndOneCutShort",
               two_boards_and("left3.png", std::string("\x89PNG\r\n\x1a\n") + "IHDR"), "",
               {"2 usable views", "skipped left3.png: is cut short"}),
        images("TwoUsableAndOneThatIsNoImage", two_boards_and("left3.png", "no image"), "",
               {"2 usable views", "skipped left3.png: cannot be read as an image"})}),
    name_of_case);

TEST(CalibrateImages, GoesOnWithoutTheBadOnesAndNamesThem) {
  const SoundFolder folder;
  board_images(4)(folder);
  blank_image("left5.png", 640, 480)(folder);
  blank_image("left6.png", 320, 240)(folder);
  written("left7.png", "no image")(folder);
  written("left8.png", read_file(folder / "left1.png").substr(0, 3000))(folder);
  const Outcome run = run_bpms(folder, calibrate_images + " --report r.json");
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.error, HasSubstr("skipped left5.png: no whole 9x6 chessboard found"));
  EXPECT_THAT(run.error, HasSubstr("skipped left6.png: 320x240 pixels"));
  EXPECT_THAT(run.error, HasSubstr("skipped left7.png: cannot be read as an image"));
  EXPECT_THAT(run.error, HasSubstr("skipped left8.png"));
  const Json report = Json::parse(read_file(folder / "r.json"));
  ASSERT_EQ(report["skipped"].size(), 4u);
  EXPECT_EQ(report["skipped"][0]["image"], "left5.png");
  EXPECT_EQ(report["views"].size(), 4u);
}

}  // namespace
}  // namespace bpms::test
