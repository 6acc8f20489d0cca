#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "calibrate/rig.h"
#include "tests/data.h"

namespace bpms {
namespace {

const char* const good = R"(units = "m"
pixel_centre = "integer"
[[cameras]]
name = "left"
size_px = [640, 480]
model = "brown_conrady"
parameters = [533.8, 533.9, 342.5, 234.8, -0.287, 0.090, 0.0012, -0.0002]
cam_from_rig = [[1,0,0,0],[0,1,0,0],[0,0,1,0]]
identity = { serial = "", lens = "8 mm", focus = "", aperture = "", date = "" }
[[cameras]]
name = "right"
size_px = [640, 480]
model = "brown_conrady"
parameters = [500, 500, 320, 240]
cam_from_rig = [[1,0,0,-0.1],[0,1,0,0],[0,0,1,0]]
[covariance]
order = ["left.fx", "right.tx"]
matrix = [[0.1, 0.001], [0.001, 0.1]]
kind = "clustered"
residual_sigma_px = 0.150
)";

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = good;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(RigToml, ReadsTheContract) {
  const test::TemporaryFolder folder;
  const Rig rig = read_rig(folder.write("rig.toml", good));
  ASSERT_EQ(rig.cameras.size(), 2u);
  EXPECT_EQ(rig.find("right"), 1);
  EXPECT_EQ(rig.find("top"), -1);
  EXPECT_EQ(rig.cameras[0].width_px, 640);
  EXPECT_EQ(rig.cameras[0].identity.at("lens"), "8 mm");
  EXPECT_DOUBLE_EQ(rig.cameras[0].parameters[4], -0.287);
  EXPECT_DOUBLE_EQ(rig.cameras[1].t_cam_from_rig_m.x(), -0.1);
  ASSERT_TRUE(rig.covariance);
  EXPECT_EQ(rig.covariance->order[1], "right.tx");
  EXPECT_EQ(rig.covariance->kind, "clustered");
  EXPECT_DOUBLE_EQ(rig.covariance->matrix(0, 1), 0.001);
  EXPECT_DOUBLE_EQ(rig.residual_sigma_px, 0.15);
}

TEST(RigToml, ReadsBackExactly) {
  Rig rig;
  for (const char* name : {"left", "right"}) {
    Camera camera;
    camera.name = name;
    camera.width_px = 1282;
    camera.height_px = 1110;
    camera.parameters = {1e3 / 3, 1e3 / 7, 0.1 + 0.2, 1.0 / 3, -1e-17, 2.0 / 3, 1e-300, -0.0, 5};
    camera.r_cam_from_rig = Eigen::AngleAxisd(0.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    camera.t_cam_from_rig_m = {1.0 / 3, -1.0 / 7, 1e-9};
    camera.identity["serial"] = "a \"quoted\" \\ name";
    camera.identity["odd key"] = "x";
    rig.cameras.push_back(camera);
  }
  rig.covariance.emplace();
  rig.covariance->order = {"left.k3", "right.rx"};
  rig.covariance->matrix = (Eigen::Matrix2d() << 1.0 / 3, 0.1, 0.1, 1.0 / 7).finished();
  rig.covariance->kind = "iid";
  rig.residual_sigma_px = 0.1;
  const test::TemporaryFolder folder;
  const Rig back = read_rig(folder.write("rig.toml", rig_toml(rig, "first line\nsecond line")));
  EXPECT_EQ(rig_toml(back), rig_toml(rig));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.cameras[i].parameters, rig.cameras[i].parameters);
    EXPECT_EQ(back.cameras[i].r_cam_from_rig, rig.cameras[i].r_cam_from_rig);
    EXPECT_EQ(back.cameras[i].t_cam_from_rig_m, rig.cameras[i].t_cam_from_rig_m);
    EXPECT_EQ(back.cameras[i].identity, rig.cameras[i].identity);
  }
  EXPECT_EQ(back.covariance->matrix, rig.covariance->matrix);
  EXPECT_EQ(back.residual_sigma_px, rig.residual_sigma_px);
}

struct BadRig {
  const char *from, *to, *message;
};
class RigErrors : public ::testing::TestWithParam<BadRig> {};

TEST_P(RigErrors, AreLocated) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("bad.toml", replaced(GetParam().from, GetParam().to));
  BPMS_EXPECT_ERROR(read_rig(path), ErrorKind::bad_input, GetParam().message);
  BPMS_EXPECT_ERROR(read_rig(path), ErrorKind::bad_input, "bad.toml:");
}

INSTANTIATE_TEST_SUITE_P(
    Each, RigErrors,
    ::testing::Values(
        BadRig{"units = \"m\"", "units = \"mm\"", "bad.toml:1:"},
        BadRig{"\"integer\"", "\"half\"", "bad.toml:2:"},
        BadRig{"pixel_centre = \"integer\"\n", "", "pixel_centre"}, BadRig{"size_px", "size", "size"},
        BadRig{"[640, 480]", "[640]", "bad.toml:5:"}, BadRig{"[640, 480]", "[0, 480]", "bad.toml:5:"},
        BadRig{"[640, 480]", "[640.5, 480]", "bad.toml:5:"},
        BadRig{"brown_conrady", "fisheyes", "bad.toml:6:"},
        BadRig{", -0.0002]", "]", "7 parameters; expected 4, 8, 9 or 12"},
        BadRig{"533.8,", "-533.8,", "bad.toml:7:"}, BadRig{"533.8,", "nan,", "bad.toml:7:"},
        BadRig{"533.8,", "\"533.8\",", "bad.toml:7:"},
        BadRig{"[[1,0,0,0],", "[[1,0.1,0,0],",
               "bad.toml:8:16: cameras[0].cam_from_rig: the left 3x3 block is no rotation"},
        BadRig{"[[1,0,0,0],", "[[-1,0,0,0],", "reflection"},
        BadRig{"[[1,0,0,0],", "[[1,0,0],", "bad.toml:8:"},
        BadRig{"[0,1,0,0],[0,0,1,0]]\nid", "[0,1,0,0]]\nid", "3 rows"},
        BadRig{"[[1,0,0,0],", "[[inf,0,0,0],", "bad.toml:8:"},
        BadRig{"\"right\"", "\"left\"", "a second camera named"},
        BadRig{"\"left\"", "\"\"", "expected a name"}, BadRig{"left.fx", "left.f", "is no parameter"},
        BadRig{"\"right.tx\"", "\"left.fx\"", "named twice"},
        BadRig{"[[0.1, 0.001], [0.001, 0.1]]", "[[0.1, 0.001]]", "expected 2 rows"},
        BadRig{"[[0.1, 0.001]", "[[0.1, 0.002]", "not symmetric"},
        BadRig{"[[0.1, 0.001], [0.001, 0.1]]", "[[0.1, 0.2], [0.2, 0.1]]", "not positive semidefinite"},
        BadRig{"[[0.1,", "[[-0.1,", "negative"}, BadRig{"\"clustered\"", "\"guessed\"", "bad.toml:19:"},
        BadRig{"0.150", "-1", "bad.toml:20:"}));

}  // namespace
}  // namespace bpms
