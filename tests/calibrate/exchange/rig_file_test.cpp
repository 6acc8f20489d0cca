#include "calibrate/exchange/rig_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/json.h"
#include "tests/calibrate/exchange/random_rig.h"
#include "tests/tool.h"

namespace bpms {
namespace {

using ::testing::HasSubstr;
constexpr double same_px = 1e-9;  // rounding of poses that are put together and taken apart

Rig random_rig(std::vector<std::size_t> parameters, bool first_at_origin = false) {
  Philox random(11);
  Rig rig;
  for (const std::size_t count : parameters)
    rig.cameras.push_back(test::random_camera(
        fmt::format("camera{}", static_cast<char>('A' + rig.cameras.size())), count, random));
  if (first_at_origin) {
    rig.cameras[0].r_cam_from_rig.setIdentity();
    rig.cameras[0].t_cam_from_rig_m.setZero();
  }
  return rig;
}

Rig there_and_back(const Rig& rig, const std::string& to, const std::string& format,
                   const RigReading& reading = {}) {
  const test::TemporaryFolder folder;
  write_rig_file(rig, folder / to, format);
  std::vector<std::string> paths;
  if (to.ends_with('/') && format != "colmap") {
    for (const RigFileText& file : rig_files(rig, folder / to, format).files) paths.push_back(file.path);
  } else {
    paths = {folder / to};
  }
  return read_rig_file(paths, reading).rig;
}

struct RoundTrip {
  std::string to, format;
  std::vector<std::size_t> parameters;
};
class RigFileRoundTrip : public ::testing::TestWithParam<RoundTrip> {};

TEST_P(RigFileRoundTrip, ProjectsTheSame) {
  const auto& [to, format, parameters] = GetParam();
  const Rig rig = random_rig(parameters);
  const Rig back = there_and_back(rig, to, format);
  ASSERT_EQ(back.cameras.size(), rig.cameras.size());
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    if (to != "one.cameramodel") {  // the file's name is the camera's there
      EXPECT_EQ(back.cameras[c].name, rig.cameras[c].name);
    }
    EXPECT_EQ(back.cameras[c].width_px, rig.cameras[c].width_px);
    EXPECT_EQ(back.cameras[c].height_px, rig.cameras[c].height_px);
  }
  EXPECT_LT(test::projected_apart(rig, back), same_px);
}

INSTANTIATE_TEST_SUITE_P(
    Formats, RigFileRoundTrip,
    ::testing::Values(RoundTrip{"r.toml", "", {8, 9, 12}}, RoundTrip{"o.yml", "", {9}},
                      RoundTrip{"o.yml", "", {8, 12}}, RoundTrip{"o.xml", "", {4, 5 + 4}},
                      RoundTrip{"o.json", "", {8, 8}}, RoundTrip{"cv/", "opencv", {8, 8}},
                      RoundTrip{"c/", "colmap", {4, 8, 9, 12}}, RoundTrip{"c.yaml", "", {4, 8, 8}},
                      RoundTrip{"m/", "mrcal", {4, 8, 9, 12}}, RoundTrip{"one.cameramodel", "", {9}}));

TEST(RigFile, FisheyesProjectTheSame) {
  Philox random(5);
  Rig rig;
  rig.cameras = {test::random_fisheye("a", random), test::random_fisheye("b", random)};
  for (const auto& [to, format] : {std::pair("o.yml", ""), {"c/", "colmap"}, {"k.yaml", ""}, {"r.toml", ""}})
    EXPECT_LT(test::projected_apart(rig, there_and_back(rig, to, format)), same_px) << to;
}

TEST(RigFile, CovarianceStaysInOpenCvsFiles) {
  Rig rig = random_rig({8, 8}, true);
  rig.covariance = Rig::Covariance{{"cameraA.fx", "cameraB.tx"}, Eigen::Matrix2d::Identity(), "clustered"};
  rig.covariance->matrix(0, 1) = rig.covariance->matrix(1, 0) = 0.1 + 0.2;
  rig.residual_sigma_px = 1.0 / 7;
  for (const char* to : {"o.yml", "o.xml"}) {
    const Rig back = there_and_back(rig, to, "");
    ASSERT_TRUE(back.covariance);
    EXPECT_EQ(back.covariance->order, rig.covariance->order);
    EXPECT_EQ(back.covariance->matrix, rig.covariance->matrix);
    EXPECT_EQ(back.covariance->kind, "clustered");
    EXPECT_EQ(back.residual_sigma_px, rig.residual_sigma_px);
  }
  rig.covariance->order[0] = "cameraA.f";
  BPMS_EXPECT_ERROR(there_and_back(rig, "o.yml", ""), ErrorKind::bad_input, "cameraA.f");
}

TEST(RigFile, WhatAFormatCannotHoldIsRefused) {
  BPMS_EXPECT_ERROR(rig_files(random_rig({8, 8, 8}), "o.yml"), ErrorKind::bad_input, "--cameras");
  BPMS_EXPECT_ERROR(rig_files(random_rig({9}), "c.yaml"), ErrorKind::bad_input, "radtan has k1 k2 p1 p2");
  BPMS_EXPECT_ERROR(rig_files(random_rig({8, 8}), "a.cameramodel"), ErrorKind::bad_input, "one camera");
  BPMS_EXPECT_ERROR(rig_files(random_rig({8}), "a.txt"), ErrorKind::bad_input, "opencv, colmap, kalibr");
  BPMS_EXPECT_ERROR(rig_files(random_rig({8}), "a.txt", "kalib"), ErrorKind::bad_input,
                    "did you mean 'kalibr'");
}

TEST(RigFile, BadFilesAreLocated) {
  const test::TemporaryFolder folder;
  const auto read = [&](const std::string& name, const std::string& text) {
    read_rig_file({folder.write(name, text)});
  };
  const std::string model =
      "{\n 'lensmodel': 'LENSMODEL_OPENCV4',\n 'intrinsics': [5,5,4,3,0,0,0,0],\n"
      " 'extrinsics': [0,0,0,0,0,0],\n 'imagersize': [8,6] }\n";
  read("a.cameramodel", model);
  const auto spoilt = [&](const std::string& from, const std::string& to) {
    std::string text = model;
    return text.replace(text.find(from), from.size(), to);
  };
  BPMS_EXPECT_ERROR(read("a.cameramodel", spoilt("5,5", "5,x")), ErrorKind::bad_input,
                    "a.cameramodel:3:19: ");
  BPMS_EXPECT_ERROR(read("a.cameramodel", spoilt("5,5", "-5,5")), ErrorKind::bad_input, "positive");
  BPMS_EXPECT_ERROR(read("a.cameramodel", spoilt("5,5,", "5,")), ErrorKind::bad_input, "expected 8");
  BPMS_EXPECT_ERROR(read("a.cameramodel", spoilt("OPENCV4", "CAHVOR")), ErrorKind::bad_input,
                    "a.cameramodel:2:15: ");
  BPMS_EXPECT_ERROR(read("a.cameramodel", spoilt("8,6", "8,6.5")), ErrorKind::bad_input, "8x6.5");
  BPMS_EXPECT_ERROR(read("a.cameramodel", spoilt("[8,6] }", "[8,6]")), ErrorKind::bad_input,
                    "a.cameramodel:6:1: ");
  const std::string chain =
      "cam0:\n  camera_model: pinhole\n  intrinsics: [5, 5, 4, 3]\n"
      "  distortion_model: radtan\n  distortion_coeffs: [0, 0, 0, 0]\n  resolution: [8, 6]\n";
  read("k.yaml", chain);
  BPMS_EXPECT_ERROR(read("k.yaml", chain + "cam1:\n  camera_model: omni\n"), ErrorKind::bad_input,
                    "k.yaml:8:17: ");
  BPMS_EXPECT_ERROR(read("k.yaml", chain + "  x: [1\n"), ErrorKind::bad_input, "k.yaml:");
  BPMS_EXPECT_ERROR(read("k.yaml", "cam0:\n  camera_model: pinhole\n"), ErrorKind::bad_input,
                    "cam0.intrinsics");
  BPMS_EXPECT_ERROR(read("o.yml", "%YAML:1.0\n---\na: [\n"), ErrorKind::bad_input, "o.yml:");
  BPMS_EXPECT_ERROR(read("o.yml", "%YAML:1.0\n---\na: 1\n"), ErrorKind::bad_input, "camera_matrix");
  BPMS_EXPECT_ERROR(read("a.png", "what"), ErrorKind::bad_input, "not recognised");
}

// Kalibr's own example of its wiki has T_cn_cnm1 of the second camera 0.11 m to the side.
TEST(RigFile, KalibrsChainIsPutTogether) {
  const char* const cam =
      "  camera_model: pinhole\n  intrinsics: [461.6, 460.1, 362.7, 246.0]\n"
      "  distortion_model: none\n  resolution: [752, 480]\n";
  const std::string step =
      "  T_cn_cnm1:\n  - [0, -1, 0, -0.1]\n  - [1, 0, 0, 0.0]\n  - [0, 0, 1, 0.0]\n  - [0, 0, 0, 1]\n";
  const Rig rig =
      parse_camchain("k", std::string("cam0:\n") + cam + "cam1:\n" + step + cam + "cam2:\n" + step + cam);
  // x -> R x + t twice, by hand: (x, y) -> (-y - 0.1, x) -> (-x - 0.1, -y - 0.1).
  EXPECT_LT((rig.cameras[2].camera_from_rig({1, 2, 3}) - Eigen::Vector3d(-1.1, -2.1, 3)).norm(), 1e-15);
}

TEST(RigFile, OpenCvsOwnSolutionsAreRead) {
  BPMS_NEED_DATA("opencv-doc/intrinsics.yml");
  const std::string folder = test::data_folder() + "/opencv-doc/";
  const Rig left = read_rig_file({folder + "left_intrinsics.yml"}).rig;
  EXPECT_NEAR(left.cameras[0].parameters[0], 535.91573396163199, 1e-12);
  EXPECT_EQ(left.cameras[0].parameters.size(), 9u);
  EXPECT_EQ(left.cameras[0].width_px, 640);
  BPMS_EXPECT_ERROR(read_rig_file({folder + "intrinsics.yml"}), ErrorKind::bad_input, "--image-size");
  const Rig pair = read_rig_file({folder + "intrinsics.yml"}, {std::pair(640, 480), 1}).rig;
  EXPECT_NEAR(pair.cameras[1].parameters[2], 334.55744527912015, 1e-12);
  EXPECT_NEAR(pair.cameras[1].parameters[4], -0.16916358306948096, 1e-15);
  const Rig charuco = read_rig_file({folder + "charuco/tutorial_camera_charuco.yml"}).rig;
  EXPECT_NEAR(charuco.cameras[0].parameters[4], 0.12136925618707872, 1e-15);
}

// OpenCV's own bindings open the files; its projectPoints agrees.
TEST(RigFile, OpenCvOpensAndProjects) {
  BPMS_NEED_PYTHON("cv2", "python3-opencv");
  const test::TemporaryFolder folder;
  const Rig rig = random_rig({9, 12}, true);
  write_rig_file(rig, folder / "cv/", "opencv");
  const std::string script = folder.write("p.py", R"(
import cv2, json, sys, numpy
i = cv2.FileStorage(sys.argv[1] + "intrinsics.yml", cv2.FILE_STORAGE_READ)
e = cv2.FileStorage(sys.argv[1] + "extrinsics.yml", cv2.FILE_STORAGE_READ)
m = lambda f, k: f.getNode(k).mat()
x = numpy.array([[0.1, -0.2, 1.5], [0.4, 0.3, 2.0], [-0.3, 0.1, 1.2]])
left = cv2.projectPoints(x, numpy.zeros(3), numpy.zeros(3), m(i, "M1"), m(i, "D1"))[0]
right = cv2.projectPoints(x, cv2.Rodrigues(m(e, "R"))[0], m(e, "T"), m(i, "M2"), m(i, "D2"))[0]
assert m(e, "Q").shape == (4, 4) and m(e, "P2").shape == (3, 4)
print(json.dumps([left.reshape(-1, 2).tolist(), right.reshape(-1, 2).tolist()]))
)");
  const Json out =
      Json::parse(test::output_of(fmt::format("{} {} {}", test::python, script, folder / "cv/")));
  const std::vector<Eigen::Vector3d> x{{0.1, -0.2, 1.5}, {0.4, 0.3, 2.0}, {-0.3, 0.1, 1.2}};
  for (std::size_t c = 0; c < 2; ++c) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto pixel = project(rig.cameras[c], rig.cameras[c].camera_from_rig(x[i]));
      EXPECT_NEAR(pixel->x(), out[c][i][0].get<double>(), same_px);
      EXPECT_NEAR(pixel->y(), out[c][i][1].get<double>(), same_px);
    }
  }
}

std::string mrcal_projects(const std::vector<std::string>& paths) {
  const test::TemporaryFolder folder;
  const std::string script = folder.write("p.py", R"(
import mrcal, json, sys, numpy
x = numpy.array([[0.1, -0.2, 1.5], [0.4, 0.3, 2.0], [-0.3, 0.1, 1.2]])
out = []
for path in sys.argv[1:]:
    m = mrcal.cameramodel(path)
    p = mrcal.transform_point_rt(m.extrinsics_rt_fromref(), x)
    out.append(mrcal.project(p, *m.intrinsics()).tolist())
print(json.dumps(out))
)");
  return test::output_of(fmt::format("{} {} {}", test::python, script, fmt::join(paths, " ")));
}
void expect_mrcal_agrees(const Rig& rig, const std::vector<std::string>& paths) {
  const Json out = Json::parse(mrcal_projects(paths));
  const std::vector<Eigen::Vector3d> x{{0.1, -0.2, 1.5}, {0.4, 0.3, 2.0}, {-0.3, 0.1, 1.2}};
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    int compared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto pixel = project(rig.cameras[c], rig.cameras[c].camera_from_rig(x[i]));
      if (!pixel) continue;  // where the lens folds mrcal still gives numbers
      ++compared;
      EXPECT_NEAR(pixel->x(), out[c][i][0].get<double>(), same_px) << paths[c];
      EXPECT_NEAR(pixel->y(), out[c][i][1].get<double>(), same_px) << paths[c];
    }
    EXPECT_GT(compared, 0) << paths[c];
  }
}

TEST(RigFile, MrcalOpensAndProjects) {
  BPMS_NEED_PYTHON("mrcal", "python3-mrcal");
  const test::TemporaryFolder folder;
  const Rig rig = random_rig({4, 8, 9, 12});
  write_rig_file(rig, folder / "m/", "mrcal");
  std::vector<std::string> paths;
  for (const Camera& camera : rig.cameras) paths.push_back(folder / ("m/" + camera.name + ".cameramodel"));
  expect_mrcal_agrees(rig, paths);
}

TEST(RigFile, MrcalProjectsSplines) {
  BPMS_NEED_PYTHON("mrcal", "python3-mrcal");
  const test::TemporaryFolder folder;
  Philox random(9);
  Rig rig = random_rig({8, 8});
  for (std::size_t c = 0; c < 2; ++c) {
    Camera& camera = rig.cameras[c];
    camera.model = "splined_stereographic";
    camera.constants = {c == 0 ? 3. : 2., 10, 8, 90};
    camera.parameters.resize(4);
    for (int i = 0; i < 2 * 10 * 8; ++i) camera.parameters.push_back(random.uniform(-0.01, 0.01));
  }
  EXPECT_LT(test::projected_apart(rig, there_and_back(rig, "m/", "mrcal")), same_px);
  write_rig_file(rig, folder / "m/", "mrcal");
  expect_mrcal_agrees(rig, {folder / "m/cameraA.cameramodel", folder / "m/cameraB.cameramodel"});
  rig.cameras[0].constants[3] = 90.5;
  BPMS_EXPECT_ERROR(rig_files(rig, "m/", "mrcal"), ErrorKind::bad_input, "whole degrees");
}

TEST(RigFile, MrcalsOwnModelsProjectTheSame) {
  BPMS_NEED_DATA("calib_ref/mrcal_sub5_opencv4_left.cameramodel");
  BPMS_NEED_PYTHON("mrcal", "python3-mrcal");
  const std::string data = test::data_folder();
  const std::vector<std::string> paths{data + "/calib_ref/mrcal_sub5_opencv4_left.cameramodel",
                                       data + "/calib_ref/mrcal_sub5_opencv4_right.cameramodel",
                                       data + "/calib-misc/mrcal/pinhole-narrow-yawed-left.cameramodel"};
  const Rig rig = read_rig_file(paths).rig;
  expect_mrcal_agrees(rig, paths);
  // What the joint solve of these corners gave (design figures): 83.168 mm.
  EXPECT_NEAR((rig.cameras[1].t_cam_from_rig_m).norm(), 83.168e-3, 1e-6);
  for (const char* other : {"cam0.opencv8", "cam1.opencv8", "opencv8-0", "opencv8-1"})
    EXPECT_EQ(read_rig_file({data + "/calib-misc/mrcal/" + other + ".cameramodel"})
                  .rig.cameras[0]
                  .parameters.size(),
              12u);
}

TEST(RigFile, ColmapCountsTheCameras) {
  BPMS_NEED_TOOL("colmap help", "colmap");
  const test::TemporaryFolder folder;
  write_rig_file(random_rig({4, 8, 9, 12}), folder / "c/");
  EXPECT_THAT(
      test::output_of("QT_QPA_PLATFORM=offscreen colmap model_analyzer --path " + (folder / "c") + " 2>&1"),
      HasSubstr("Cameras: 4"));
}

}  // namespace
}  // namespace bpms
