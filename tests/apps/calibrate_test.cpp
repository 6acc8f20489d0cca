// Corners, targets and photographs that no calibration comes from, and those that it goes on without.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

#include "calibrate/adjustment/synthetic.h"
#include "core/json.h"
#include "tests/apps/refused.h"
#include "tests/command.h"
#include "tests/data.h"

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

// A pair of cameras that see six frames, in place of the folder's one camera.
void two_cameras(const SoundFolder& folder) {
  std::string out = "# filename x y level\n";
  for (const BoardView& view : observe(synthetic_calibration({.cameras = 2, .frames = 6}), 0.1, 1).views)
    for (const ImageCorner& corner : view.corners)
      out += fmt::format("{} {:.4f} {:.4f} 0\n", view.image, corner.pixel.x(), corner.pixel.y());
  folder.write("corners.vnl", out);
}

// Each residual names its point, each camera its parameters, and a pair says how sure it places points: the
// rig's part adds to that of the observation, and depth is worst.
TEST(CalibrateReport, HoldsWhatTheFiguresNeed) {
  const SoundFolder folder;
  two_cameras(folder);
  const Outcome run = run_bpms(folder, calibrate_corners + " --report r.json");
  ASSERT_EQ(run.code, 0) << run.error;
  const Json report = Json::parse(read_file(folder / "r.json"));
  for (const Json& view : report["views"]) {
    ASSERT_EQ(view["points"].size(), view["residuals"].size());
    for (std::size_t i = 1; i < view["points"].size(); ++i)
      EXPECT_LT(view["points"][i - 1].get<int>(), view["points"][i].get<int>());
  }
  const Json& covariance = report["covariance"];
  ASSERT_GT(covariance["order"].size(), 0u);
  for (std::size_t i = 0; i < covariance["order"].size(); ++i) {
    const auto name = covariance["order"][i].get<std::string>();
    for (const Json& camera : report["cameras"]) {
      const std::string prefix = camera["name"].get<std::string>() + ".";
      if (!name.starts_with(prefix)) continue;
      const Json& sigma =
          camera[covariance["kind"] == "iid" ? "sigma" : "sigma_clustered"][name.substr(prefix.size())];
      // Written with all their digits.
      EXPECT_NEAR(covariance["matrix"][i][i].get<double>(), std::pow(sigma.get<double>(), 2),
                  1e-9 * std::pow(sigma.get<double>(), 2))
          << name;
    }
  }
  ASSERT_EQ(report["pairs"].size(), 1u);
  ASSERT_GT(report["triangulation"].size(), 0u);
  for (const Json& at : report["triangulation"]) {
    for (const char* axis : {"x", "y", "z"}) {
      const std::string name = std::string("sigma_") + axis + "_m";
      EXPECT_GT(at["observation_" + name].get<double>(), 0);
      EXPECT_GT(at[name].get<double>(), at["observation_" + name].get<double>());
    }
    EXPECT_GT(at["observation_sigma_z_m"].get<double>(), at["observation_sigma_x_m"].get<double>());
  }
}

bool on_path(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

TEST(CalibrateReport, ThePageInABrowser) {
  if (!on_path("node") || !on_path("${CHROMIUM:-chromium}")) {
    if (data_required()) FAIL() << "node and chromium are required";
    GTEST_SKIP() << "needs node and chromium";
  }
  const SoundFolder folder;
  two_cameras(folder);
  const Outcome run = run_bpms(folder, calibrate_corners + " --report r.html");
  ASSERT_EQ(run.code, 0) << run.error;
  std::string figures;
  for (const char* name : {"scene", "views", "frames", "quiver", "scatter", "normal", "board", "coverage",
                           "sigma", "halves", "triangulation", "correlation"})
    figures += std::string(" calibrate-") + name;
  const int status =
      std::system(fmt::format("cd '{}' && timeout 300 node '{}/workbench/scripts/check_report.mjs' r.html{} "
                              ">out 2>&1",
                              folder / ".", BPMS_SOURCE_DIR, figures)
                      .c_str());
  EXPECT_EQ(exit_code_of(status), 0) << read_file(folder / "out");
}

}  // namespace
}  // namespace bpms::test
