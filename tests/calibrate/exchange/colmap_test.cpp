#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "calibrate/exchange/colmap_camera.h"
#include "calibrate/exchange/colmap_model.h"
#include "tests/calibrate/exchange/random_rig.h"
#include "tests/tool.h"

namespace bpms {
namespace {

// Points seen by three images of two cameras, their keypoints exactly where they project.
ColmapModel small_model() {
  Philox random(3);
  ColmapModel out;
  out.cameras = {test::random_camera("1", 8, random), test::random_camera("2", 9, random)};
  for (std::uint64_t i = 0; i < 40; ++i) {
    ColmapPoint point;
    point.id = 10 + 3 * i;
    point.x_world = {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(1.5, 2.5)};
    point.red = static_cast<std::uint8_t>(i);
    point.blue = 255;
    point.error_px = 0.25 + 0.001 * static_cast<double>(i);
    out.points.push_back(point);
  }
  for (int i = 0; i < 3; ++i) {
    ColmapImage image;
    image.id = static_cast<std::uint32_t>(5 + 2 * i);
    image.name = fmt::format("views/{}.jpg", i);
    image.camera = i % 2;
    image.cam_from_world = {rotation_from_vector(0.1 * Eigen::Vector3d(random.normal(), random.normal(), 1)),
                            {0.1 * i, random.normal() * 0.05, 0.2}};
    for (std::size_t p = 0; p < out.points.size(); ++p) {
      const auto pixel = project(out.cameras[static_cast<std::size_t>(image.camera)],
                                 image.cam_from_world * out.points[p].x_world);
      if (!pixel) continue;
      out.points[p].track.push_back({i, static_cast<int>(image.keypoints_px.size())});
      image.keypoints_px.push_back(*pixel);
      image.points.push_back(static_cast<int>(p));
    }
    image.keypoints_px.emplace_back(12.25, 30.5);
    image.points.push_back(-1);
    out.images.push_back(image);
  }
  return out;
}

void expect_same(const ColmapModel& a, const ColmapModel& b) {
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  ASSERT_EQ(a.images.size(), b.images.size());
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.images.size(); ++i) {
    const ColmapImage &x = a.images[i], &y = b.images[i];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.id, y.id);
    EXPECT_EQ(x.camera, y.camera);
    EXPECT_EQ(x.points, y.points);
    // Quaternions and half pixels round: 1e-13 of the sizes here.
    EXPECT_LT((x.cam_from_world.r - y.cam_from_world.r).norm(), 1e-13);
    EXPECT_EQ(x.cam_from_world.t_m, y.cam_from_world.t_m);
    ASSERT_EQ(x.keypoints_px.size(), y.keypoints_px.size());
    for (std::size_t k = 0; k < x.keypoints_px.size(); ++k)
      EXPECT_LT((x.keypoints_px[k] - y.keypoints_px[k]).norm(), 1e-12);
  }
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const ColmapPoint &x = a.points[i], &y = b.points[i];
    EXPECT_EQ(x.id, y.id);
    EXPECT_EQ(x.x_world, y.x_world);
    EXPECT_EQ(std::tuple(x.red, x.green, x.blue), std::tuple(y.red, y.green, y.blue));
    EXPECT_EQ(x.error_px, y.error_px);
    ASSERT_EQ(x.track.size(), y.track.size());
    for (std::size_t k = 0; k < x.track.size(); ++k) {
      EXPECT_EQ(x.track[k].image, y.track[k].image);
      EXPECT_EQ(x.track[k].keypoint, y.track[k].keypoint);
    }
  }
  for (std::size_t c = 0; c < a.cameras.size(); ++c) {
    EXPECT_EQ(a.cameras[c].parameters.size(), b.cameras[c].parameters.size());
    EXPECT_LT(test::projected_apart({{a.cameras[c]}, {}, 0}, {{b.cameras[c]}, {}, 0}), 1e-9);
  }
}

TEST(Colmap, TextReadsBack) {
  const test::TemporaryFolder folder;
  const ColmapModel model = small_model();
  write_colmap_model(model, folder / "model", false);
  expect_same(model, read_colmap_model(folder / "model"));
  BPMS_EXPECT_ERROR(write_colmap_model(model, folder / "model", false), ErrorKind::bad_input, "cameras.txt");
}

// Image 640x480, principal point in the middle of the image: between the centres of pixels 319 and 320, which
// COLMAP writes 320 and OpenCV 319.5.
TEST(Colmap, PixelCentresAreShiftedByHalfAPixel) {
  const ColmapModel model = parse_colmap_text({"c", "1 SIMPLE_RADIAL 640 480 500 320 240 -0.1\n", "i",
                                               "1 1 0 0 0 0 0 0 1 a b.png\n320 240 -1\n", "p", ""});
  EXPECT_EQ(model.cameras[0].parameters, (std::vector<double>{500, 500, 319.5, 239.5, -0.1, 0, 0, 0}));
  EXPECT_EQ(model.images[0].keypoints_px[0], Eigen::Vector2d(319.5, 239.5));
  EXPECT_EQ(model.images[0].name, "a b.png");
  // On the axis of the camera: where the keypoint is.
  EXPECT_EQ(*project(model.cameras[0], Eigen::Vector3d(0, 0, 2)), Eigen::Vector2d(319.5, 239.5));
  EXPECT_EQ(colmap_parameters(model.cameras[0]).numbers[2], 320);
}

TEST(Colmap, ModelsBecomeLenses) {
  const auto read = [](const std::string& line) {
    return parse_colmap_text({"c", "4 " + line + "\n", "i", "", "p", ""}).cameras[0].parameters;
  };
  EXPECT_EQ(read("SIMPLE_PINHOLE 8 6 5 4.5 3.5"), (std::vector<double>{5, 5, 4, 3}));
  EXPECT_EQ(read("PINHOLE 8 6 5 6 4.5 3.5"), (std::vector<double>{5, 6, 4, 3}));
  EXPECT_EQ(read("RADIAL 8 6 5 4.5 3.5 .1 .2"), (std::vector<double>{5, 5, 4, 3, .1, .2, 0, 0}));
  EXPECT_EQ(read("OPENCV 8 6 5 6 4.5 3.5 .1 .2 .3 .4"), (std::vector<double>{5, 6, 4, 3, .1, .2, .3, .4}));
  EXPECT_EQ(read("FULL_OPENCV 8 6 5 6 4.5 3.5 .1 .2 .3 .4 .5 .6 .7 .8"),
            (std::vector<double>{5, 6, 4, 3, .1, .2, .3, .4, .5, .6, .7, .8}));
  EXPECT_EQ(read("FULL_OPENCV 8 6 5 6 4.5 3.5 .1 .2 .3 .4 .5 0 0 0"),
            (std::vector<double>{5, 6, 4, 3, .1, .2, .3, .4, .5}));
  EXPECT_EQ(read("OPENCV_FISHEYE 8 6 5 6 4.5 3.5 .1 .2 .3 .4"),
            (std::vector<double>{5, 6, 4, 3, .1, .2, .3, .4}));
  for (const ColmapLens* lens : {find_colmap_lens("OPENCV"), find_colmap_lens(4)})
    EXPECT_EQ(lens, find_colmap_lens("OPENCV"));
}

// A camera, an image and a point, byte by byte.
struct Bytes {
  std::string text;
  template <class T>
  Bytes& add(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    text.append(raw, sizeof(T));
    return *this;
  }
};
ColmapFiles binary_files() {
  Bytes cameras, images, points;
  cameras.add<std::uint64_t>(1).add<std::uint32_t>(9).add<std::int32_t>(1);
  cameras.add<std::uint64_t>(640).add<std::uint64_t>(480).add(500.).add(501.).add(320.).add(240.);
  images.add<std::uint64_t>(1).add<std::uint32_t>(3).add(1.).add(0.).add(0.).add(0.).add(.1).add(.2).add(.3);
  images.add<std::uint32_t>(9).text += std::string("left.png") + '\0';
  images.add<std::uint64_t>(2).add(10.5).add(20.5).add<std::uint64_t>(7);
  images.add(1.5).add(2.5).add<std::uint64_t>(~std::uint64_t{0});
  points.add<std::uint64_t>(1).add<std::uint64_t>(7).add(1.).add(2.).add(3.);
  points.add<std::uint8_t>(1).add<std::uint8_t>(2).add<std::uint8_t>(255).add(0.5);
  points.add<std::uint64_t>(1).add<std::uint32_t>(3).add<std::uint32_t>(0);
  return {"cameras.bin", cameras.text, "images.bin", images.text, "points3D.bin", points.text};
}

TEST(Colmap, BinaryIsRead) {
  const ColmapModel model = parse_colmap_binary(binary_files());
  EXPECT_EQ(model.cameras[0].parameters, (std::vector<double>{500, 501, 319.5, 239.5}));
  EXPECT_EQ(model.images[0].name, "left.png");
  EXPECT_EQ(model.images[0].cam_from_world.t_m, Eigen::Vector3d(.1, .2, .3));
  EXPECT_EQ(model.images[0].keypoints_px[0], Eigen::Vector2d(10, 20));
  EXPECT_EQ(model.images[0].points, (std::vector<int>{0, -1}));
  EXPECT_EQ(model.points[0].x_world, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(model.points[0].blue, 255);
  EXPECT_EQ(model.points[0].track[0].image, 0);
}

TEST(Colmap, BinaryCutAnywhereIsRefused) {
  const ColmapFiles whole = binary_files();
  for (std::string ColmapFiles::*part : {&ColmapFiles::cameras, &ColmapFiles::images, &ColmapFiles::points}) {
    for (std::size_t size = 0; size < (whole.*part).size(); ++size) {
      ColmapFiles cut = whole;
      (cut.*part).resize(size);
      EXPECT_THROW(parse_colmap_binary(cut), Error) << size;
    }
    ColmapFiles longer = whole;
    (longer.*part) += '\0';
    BPMS_EXPECT_ERROR(parse_colmap_binary(longer), ErrorKind::bad_input, "left over");
  }
}

// Whichever coordinate it is: a maximum over a vector may pass over it.
TEST(Colmap, BinaryNumbersThatAreNoneAreRefused) {
  const auto spoilt = [](std::string ColmapFiles::*part, std::size_t at) {
    ColmapFiles files = binary_files();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::memcpy((files.*part).data() + at, &nan, sizeof nan);
    return files;
  };
  for (std::size_t i = 0; i < 3; ++i)
    BPMS_EXPECT_ERROR(parse_colmap_binary(spoilt(&ColmapFiles::points, 16 + 8 * i)), ErrorKind::bad_input,
                      "point 7");
  for (std::size_t i = 0; i < 3; ++i)
    BPMS_EXPECT_ERROR(parse_colmap_binary(spoilt(&ColmapFiles::images, 44 + 8 * i)), ErrorKind::bad_input,
                      "translation");
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_THROW(parse_colmap_binary(spoilt(&ColmapFiles::images, 12 + 8 * i)), Error);
    EXPECT_THROW(parse_colmap_binary(spoilt(&ColmapFiles::cameras, 32 + 8 * i)), Error);
  }
}

TEST(Colmap, SaysWhereTheTextIsWrong) {
  const std::string camera = "1 PINHOLE 8 6 5 6 4 3\n", image = "1 1 0 0 0 0 0 0 1 a.png\n";
  const auto read = [](const std::string& cameras, const std::string& images, const std::string& points) {
    return parse_colmap_text({"c.txt", cameras, "i.txt", images, "p.txt", points});
  };
  BPMS_EXPECT_ERROR(read("# c\n1 PINHOL 8 6 5 6 4 3\n", "", ""), ErrorKind::bad_input, "c.txt:2:3: ");
  BPMS_EXPECT_ERROR(read("1 PINHOLE 8 6 5 6 4\n", "", ""), ErrorKind::bad_input, "3 parameters");
  BPMS_EXPECT_ERROR(read("1 PINHOLE 8 6 -5 6 4 3\n", "", ""), ErrorKind::bad_input, "positive");
  BPMS_EXPECT_ERROR(read("1 FOV 8 6 5 6 4 3 1\n", "", ""), ErrorKind::bad_input, "no counterpart");
  BPMS_EXPECT_ERROR(read(camera, "1 1 0 0 1 0 0 0 1 a.png\n", ""), ErrorKind::bad_input,
                    "i.txt:1:3: the quat");
  BPMS_EXPECT_ERROR(read(camera, "1 1 0 0 0 0 0 0 2 a.png\n", ""), ErrorKind::bad_input, "camera 2");
  BPMS_EXPECT_ERROR(read(camera, image + "1 2 5\n", ""), ErrorKind::bad_input, "point 5");
  BPMS_EXPECT_ERROR(read(camera, image + "1 x -1\n", ""), ErrorKind::bad_input, "i.txt:2:3: found 'x'");
  BPMS_EXPECT_ERROR(read(camera, image, "7 0 0 1 0 0 0 0.1 1 0\n"), ErrorKind::bad_input, "keypoint 0");
  BPMS_EXPECT_ERROR(read(camera, image, "7 0 0 1 0 0 256 0.1\n"), ErrorKind::bad_input, "p.txt:1:13: ");
  BPMS_EXPECT_ERROR(read(camera + camera, "", ""), ErrorKind::bad_input, "a second camera");
}

// COLMAP itself reads the text, finds the same counts and writes its binary files, which are read here.
TEST(Colmap, ColmapOpensTheModelAndItsBinaryFilesAreRead) {
  BPMS_NEED_TOOL("colmap help", "colmap");
  const test::TemporaryFolder folder;
  const ColmapModel model = small_model();
  write_colmap_model(model, folder / "text", false);
  std::filesystem::create_directory(folder / "binary");
  const std::string colmap = "QT_QPA_PLATFORM=offscreen colmap ";
  EXPECT_THAT(
      test::output_of(colmap + "model_analyzer --path " + (folder / "text") + " 2>&1"),
      ::testing::AllOf(::testing::HasSubstr("Cameras: 2"), ::testing::HasSubstr("Registered images: 3"),
                       ::testing::HasSubstr("Points: 40")));
  test::output_of(colmap + "model_converter --input_path " + (folder / "text") + " --output_path " +
                  (folder / "binary") + " --output_type BIN");
  const ColmapModel binary = read_colmap_model(folder / "binary");
  // COLMAP writes images and points in the order of its tables.
  ASSERT_EQ(binary.points.size(), model.points.size());
  for (const ColmapImage& image : model.images) {
    const int at = binary.find_image(image.name);
    ASSERT_GE(at, 0);
    const ColmapImage& there = binary.images[static_cast<std::size_t>(at)];
    EXPECT_LT((there.cam_from_world.r - image.cam_from_world.r).norm(), 1e-12);
    ASSERT_EQ(there.keypoints_px.size(), image.keypoints_px.size());
    const Camera& camera = binary.cameras[static_cast<std::size_t>(there.camera)];
    int seen = 0;
    for (std::size_t k = 0; k < there.keypoints_px.size(); ++k) {
      if (there.points[k] < 0) continue;
      const ColmapPoint& point = binary.points[static_cast<std::size_t>(there.points[k])];
      // The keypoint lies where its point projects: shift, pose and lens fit each other.
      EXPECT_LT((*project(camera, there.cam_from_world * point.x_world) - there.keypoints_px[k]).norm(),
                1e-9);
      ++seen;
    }
    EXPECT_GT(seen, 30);
  }
}

}  // namespace
}  // namespace bpms
