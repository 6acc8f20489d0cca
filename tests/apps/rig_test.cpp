// Rigs shown, converted and checked, as users do it.
#include <gmock/gmock.h>

#include "calibrate/pose.h"
#include "calibrate/rig.h"
#include "core/json.h"
#include "core/units.h"
#include "tests/apps/sound_folder.h"
#include "tests/command.h"

namespace bpms::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const char* const two_cameras = R"(units = "m"
pixel_centre = "integer"
[[cameras]]
name = "left"
size_px = [640, 480]
model = "brown_conrady"
parameters = [533.8, 533.9, 342.5, 234.8, -0.287, 0.090, 0.0012, -0.0002]
cam_from_rig = [[1,0,0,0],[0,1,0,0],[0,0,1,0]]
identity = { serial = "0042" }
[[cameras]]
name = "right"
size_px = [640, 480]
model = "brown_conrady"
parameters = [500, 500, 320, 240]
cam_from_rig = [[1,0,0,-0.1],[0,1,0,0],[0,0,1,0]]
[covariance]
order = ["left.fx", "right.tx"]
matrix = [[0.25, 0], [0, 1e-8]]
kind = "iid"
residual_sigma_px = 0.150
)";

TEST(RigVerb, ShowsSigmasIdentityAndBaselines) {
  const TemporaryFolder folder;
  folder.write("rig.toml", two_cameras);
  const Outcome run = run_bpms(folder, "rig show rig.toml --report r.json");
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.out, AllOf(HasSubstr("533.8 +- 0.5"), HasSubstr("serial: 0042"),
                             HasSubstr("100.0000 mm +- 0.1 apart")));
  const Json report = Json::parse(read_file(folder / "r.json"));
  EXPECT_NEAR(report["pairs"][0]["baseline_sigma_m"].get<double>(), 1e-4, 1e-12);
}

TEST(RigVerb, ConvertsThereAndBack) {
  const TemporaryFolder folder;
  folder.write("rig.toml", two_cameras);
  const auto convert = [&](const std::string& arguments) {
    const Outcome run = run_bpms(folder, "rig convert " + arguments);
    EXPECT_EQ(run.code, 0) << arguments << "\n" << run.error;
    return run.error;
  };
  EXPECT_THAT(convert("rig.toml -o chain.yaml"), HasSubstr("covariance"));
  convert("chain.yaml --to mrcal -o models/");
  convert("models/left.cameramodel models/right.cameramodel -o pair.yml");
  convert("pair.yml --to colmap -o sparse/");
  convert("sparse --cameras right,left -o back.toml");
  const Rig rig = read_rig(folder / "rig.toml"), back = read_rig(folder / "back.toml");
  ASSERT_EQ(back.cameras[0].name, "right");
  EXPECT_NEAR((back.cameras[0].t_cam_from_rig_m - rig.cameras[1].t_cam_from_rig_m).norm(), 0, 1e-15);
  EXPECT_NEAR((*project(back.cameras[1], {0.1, 0.2, 1}) - *project(rig.cameras[0], {0.1, 0.2, 1})).norm(), 0,
              1e-9);
}

TEST(RigVerb, WrongArgumentsAreRefusedInOneLine) {
  const TemporaryFolder folder;
  folder.write("rig.toml", two_cameras);
  const auto refused = [&](const std::string& arguments, const std::string& part) {
    const Outcome run = run_bpms(folder, "rig " + arguments);
    EXPECT_EQ(run.code, 2) << arguments;
    EXPECT_THAT(run.error, HasSubstr(part));
  };
  refused("convert rig.toml", "give -o FILE");
  refused("convert rig.toml -o a.txt", "does not say the format");
  refused("convert rig.toml -o a.toml --to kalib", "did you mean 'kalibr'?");
  refused("convert rig.toml -o a.toml --cameras top", "no camera 'top'");
  refused("convert rig.toml -o rig.toml", "rig.toml");
  refused("turn rig.toml", "action");
  refused("show rig.toml --image-size 3", "WIDTHxHEIGHT");
}

// Photographs of one camera calibrate it; a shot then holds, and does not when the rig says another focal
// length.
TEST(CheckVerb, HoldsAndDoesNot) {
  const TemporaryFolder folder;
  board_images(4)(folder);
  ASSERT_EQ(run_bpms(folder,
                     "calibrate --images 'left[1-3].png' --target chessboard:9x6:20mm -o rig.toml "
                     "--identity left.serial=0042 left.temperature=21")
                .code,
            0);
  Rig rig = read_rig(folder / "rig.toml");
  EXPECT_EQ(rig.cameras[0].identity.at("temperature"), "21");
  // Corners of the fourth drawing err by more than those of the three before; 0.1 px is said to be enough.
  const std::string check =
      "calibrate --check rig.toml left4.png --target chessboard:9x6:20mm --corner-sigma 0.1";
  Outcome run = run_bpms(folder, check + " --report r.json");
  EXPECT_EQ(run.code, 0) << run.error << run.out;
  EXPECT_THAT(run.out, HasSubstr("lens of left"));
  EXPECT_TRUE(Json::parse(read_file(folder / "r.json"))["holds"].get<bool>());
  std::filesystem::copy_file(folder / "left4.png", folder / "shot_left.png");
  EXPECT_EQ(
      run_bpms(folder,
               "calibrate --check rig.toml shot_left.png --target chessboard:9x6:20mm --corner-sigma 0.1")
          .code,
      0);
  rig.cameras[0].parameters[0] *= 1.1;  // no longer square pixels
  folder.write("rig.toml", rig_toml(rig));
  run = run_bpms(folder, check + " --report r2.json");
  EXPECT_EQ(run.code, 5) << run.out;
  EXPECT_THAT(run.error, HasSubstr("the lens of camera 'left' is not as calibrated"));
  EXPECT_FALSE(Json::parse(read_file(folder / "r2.json"))["holds"].get<bool>());
  EXPECT_EQ(run_bpms(folder, check + " -o x.toml").code, 2);
  EXPECT_EQ(run_bpms(folder, "calibrate --check rig.toml --target chessboard:9x6:20mm").code, 2);
}

}  // namespace
}  // namespace bpms::test
