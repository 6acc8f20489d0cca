// The verb as users run it: outputs, exit codes, report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/json.h"
#include "core/png.h"
#include "core/units.h"
#include "tests/command.h"
#include "tests/reconstruct/synthetic.h"

namespace bpms {
namespace {

using test::Outcome, test::run_bpms;
using ::testing::HasSubstr;

std::string rows(const Rig& rig, const std::string& label, int point, const Eigen::Vector3d& x) {
  std::string out;
  for (const ImagePoint& p : test::image_points(rig, point, test::sight(rig, x, 0.5, nullptr)))
    out += fmt::format("{},{},a,{},{},{},0.5\n", label, point, p.camera, p.u_px, p.v_px);
  return out;
}

const std::string header = "plant,axis,rank,organ,feature,point,view,camera,u_px,v_px,sigma_px\n";

void prepare(const test::TemporaryFolder& folder) {
  Rig rig = test::parallel_rig();
  for (Camera& c : rig.cameras) c.height_px = 1300;
  test::give_covariance(rig, 0.1, 100);
  folder.write("rig.toml", rig_toml(rig));
  std::string points = header + rows(rig, "1,1,0,bud,axis", 1, {0.01, 0.08, 1.5});
  for (int i = 1; i <= 3; ++i) points += rows(rig, "1,1,1,leaf,midrib", i, {0.01, 0.08 - 0.03 * i, 1.5});
  points += "1,1,1,leaf,midrib,4,a,left,1200,600,0.5\n1,1,1,leaf,midrib,4,a,right,400,604,0.5\n";
  folder.write("points.csv", points);
  std::string pot = header;
  const Eigen::Vector3d across(1, 0, 0), away = Eigen::Vector3d(0, 0.1, 1).normalized();
  for (int i = 0; i < 12; ++i) {
    const double angle = pi * (i / 11.0 - 1);
    const Eigen::Vector3d x =
        Eigen::Vector3d(0, 0.1, 1.5) + 0.08 * (std::cos(angle) * across + std::sin(angle) * away);
    pot += rows(rig, "1,1,0,pot,outline", i, x);
  }
  folder.write("pot.csv", pot);
  RgbImage picture{1600, 1300, std::vector<std::uint8_t>(std::size_t{3} * 1600 * 1300, 90)};
  folder.write("left.png", encode_png(picture));
}

TEST(Command, VectorsFrameAndReport) {
  const test::TemporaryFolder folder;
  prepare(folder);
  const Outcome run =
      run_bpms(folder,
               "reconstruct points.csv --rig rig.toml -o v.csv --up-from pot.csv --origin organ=bud "
               "--photographs left=left.png --report r.json");
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_THAT(run.error, HasSubstr("rejected: plant 1 axis 1 rank 1 leaf midrib point 4: chi2 = "));
  const auto vectors = read_vectors(folder / "v.csv");
  ASSERT_EQ(vectors.size(), 4u);
  EXPECT_LT(vectors[0].x_m.norm(), 1e-9);  // the bud
  // The rim leans by atan(0.1) towards the camera: a leaf that runs up in the image leans back by as much.
  for (int i = 1; i <= 3; ++i) {
    const auto& v = vectors[static_cast<std::size_t>(i)];
    EXPECT_NEAR(v.x_m.norm(), 0.03 * i, 1e-6);
    EXPECT_NEAR(std::atan2(std::hypot(v.x_m.x(), v.x_m.y()), v.x_m.z()), std::atan(0.1), 1e-5);
  }
  const Json report = Json::parse(read_file(folder / "r.json"));
  EXPECT_EQ(report["report"], "reconstruct");
  EXPECT_EQ(report["points"], 4);
  ASSERT_EQ(report["rejected"].size(), 1u);
  EXPECT_EQ(report["rejected"][0]["feature"], "midrib");
  EXPECT_EQ(report["rejected"][0]["point"], 4);
  EXPECT_EQ(report["rejected"][0]["reason"], "chi2");
  EXPECT_NEAR(report["rejected"][0]["chi2"].get<double>(), 4 * 4 / (2 * 0.25), 2.0);
  EXPECT_LT(report["reprojection_rms_px"].get<double>(), 1e-6);
  ASSERT_EQ(report["curves"].size(), 2u);
  const Json& point = report["curves"][1]["points"][1];
  EXPECT_EQ(report["curves"][1]["organ"], "leaf");
  EXPECT_EQ(point["sigma_m"].size(), 3u);
  EXPECT_NEAR(point["digitised"]["left"][0].get<double>(), point["reprojected"]["left"][0].get<double>(),
              1e-6);
  EXPECT_EQ(report["figures"][0]["name"], "pot rim diameter");
  EXPECT_NEAR(report["figures"][0]["value"].get<double>(), 0.16, 1e-6);
  EXPECT_GT(report["figures"][0]["sigma"].get<double>(), 0);
  EXPECT_EQ(report["vertical_m"], (Json{0.0, 0.0, 1.0}));
  EXPECT_LT(report["towards_cameras"][1].get<double>(), -0.9);  // the cameras look along +y
  EXPECT_EQ(report["photographs"][0]["camera"], "left");
  EXPECT_EQ(report["photographs"][0]["view"], "a");
  EXPECT_EQ(report["photographs"][0]["height"], 1300);
  EXPECT_THAT(report["photographs"][0]["data_uri"].get<std::string>(),
              ::testing::StartsWith("data:image/png;base64,"));
  EXPECT_EQ(report["provenance"]["inputs"].size(), 4u);
}

TEST(Command, VectorsGoToStandardOutput) {
  const test::TemporaryFolder folder;
  prepare(folder);
  const Outcome run = run_bpms(folder, "reconstruct points.csv --rig rig.toml --quiet");
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.error, "");
  EXPECT_EQ(read_vectors(folder.write("v.csv", run.out)).size(), 4u);
  const Outcome digitising =
      run_bpms(folder, "reconstruct points.csv --rig rig.toml --quiet --covariance digitising");
  const auto total = read_vectors(folder / "v.csv"),
             alone = read_vectors(folder.write("d.csv", digitising.out));
  EXPECT_EQ(total[1].x_m, alone[1].x_m);
  EXPECT_GT(total[1].covariance_m2.trace(), alone[1].covariance_m2.trace());
}

TEST(Command, ANameInLatin1DoesNotCostTheReport) {
  const test::TemporaryFolder folder;
  prepare(folder);
  folder.write("latin.csv", header + rows(test::parallel_rig(), "bl\xe9,1,1,leaf,midrib", 1, {0, 0, 1.5}));
  const Outcome run = run_bpms(folder, "reconstruct latin.csv --rig rig.toml --json");
  ASSERT_EQ(run.code, 0) << run.error;
  EXPECT_EQ(Json::parse(run.out)["curves"][0]["plant"], "bl\xef\xbf\xbd");
}

TEST(Command, RefusalsEndWithOneLineAndTheirCode) {
  const test::TemporaryFolder folder;
  prepare(folder);
  folder.write("bad.csv",
               header +
                   "1,1,1,leaf,midrib,4,a,left,1200,600,0.5\n1,1,1,leaf,midrib,4,a,right,400,650,0.5\n"
                   "1,1,1,leaf,midrib,5,a,left,1200,600,0.5\n");
  folder.write("unknown.csv", header + "1,1,1,leaf,midrib,4,a,middle,1200,600,0.5\n");
  struct Case {
    std::string arguments;
    int code;
    std::string message;
  };
  const std::vector<Case> cases{
      {"bad.csv --rig rig.toml", 4,
       "error: bad.csv: all 2 points were rejected: 1 chi2, 1 seen in one image only"},
      {"unknown.csv --rig rig.toml", 2,
       "error: unknown.csv:2:19: the rig has no camera 'middle'; known: left, right"},
      {"none.csv --rig rig.toml", 3, "error: none.csv"},
      {"points.csv --rig points.csv", 2, "error: points.csv:1:"},
      {"points.csv --rig rig.toml --up 0,0,0", 2, "--up: found '0,0,0', which has no direction"},
      {"points.csv --rig rig.toml --up 1,2", 2, "--up: found '1,2', expected X,Y,Z"},
      {"points.csv --rig rig.toml --photographs lft=left.png", 2, "no camera 'lft'; did you mean 'left'?"},
      {"points.csv --rig rig.toml --photographs left=points.csv", 2, "error: points.csv: not an image"},
      {"points.csv --rig rig.toml --up-from points.csv", 2, "0 accepted points labelled organ 'pot'"},
      {"points.csv --rig rig.toml --check-disparity left.png -o v.csv", 0, ""},
  };
  for (const Case& c : cases) {
    const Outcome run = run_bpms(folder, "reconstruct --quiet " + c.arguments);
    EXPECT_EQ(run.code, c.code) << c.arguments << "\n" << run.error;
    EXPECT_THAT(run.error, HasSubstr(c.message)) << c.arguments;
  }
}

}  // namespace
}  // namespace bpms
