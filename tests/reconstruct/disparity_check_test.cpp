#include "reconstruct/points/disparity_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/png.h"
#include "tests/data.h"
#include "tests/reconstruct/synthetic.h"

namespace bpms {
namespace {

constexpr int width = 320, height = 240;
constexpr double focal = 700, baseline = 0.16, offset = 40;

Rig rectified() {
  Rig rig;
  rig.cameras.push_back(
      test::camera("left", {0, 0, 0}, Eigen::Matrix3d::Identity(), {focal, focal, 160, 120, 0, 0, 0, 0}));
  rig.cameras.push_back(test::camera("right", {baseline, 0, 0}, Eigen::Matrix3d::Identity(),
                                     {focal, focal, 160 + offset, 120, 0, 0, 0, 0}));
  for (Camera& c : rig.cameras) {
    c.width_px = width;
    c.height_px = height;
  }
  return rig;
}

// The disparity of column u is u / 10; columns below 10 are unknown.
std::string ramp(const test::TemporaryFolder& folder, int columns = width) {
  RgbImage image{columns, height, {}};
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < columns; ++u) image.rgb.insert(image.rgb.end(), 3, static_cast<std::uint8_t>(u / 10));
  return folder.write("d.png", encode_png(image));
}

std::vector<ImagePoint> pair(const Rig& rig, int number, double u, double d, double dv = 0) {
  return test::image_points(rig, number, {{0, {u, 100 + dv}, 0.5}, {1, {u - d, 100}, 0.5}});
}

TEST(DisparityCheck, DepthsAreThoseOfTheFormula) {
  const test::TemporaryFolder folder;
  const Rig rig = rectified();
  std::vector<ImagePoint> points;
  for (const auto& rows : {pair(rig, 0, 203, 20), pair(rig, 1, 203, 21), pair(rig, 2, 203, 18),
                           pair(rig, 3, 5, 4), pair(rig, 4, 203, 20, 9)})
    points.insert(points.end(), rows.begin(), rows.end());
  const Vectors vectors = reconstruct(points, rig);
  const DisparityCheck check = check_disparity(ramp(folder), vectors, rig);
  ASSERT_EQ(check.points.size(), 4u);
  EXPECT_EQ(check.unknown, 1);
  const double z = focal * baseline / (20 + offset);
  EXPECT_NEAR(check.points[0].dz_m, 0, 1e-9);
  EXPECT_NEAR(check.points[1].dz_m, focal * baseline / (21 + offset) - z, 1e-9);
  EXPECT_NEAR(check.points[2].dz_m, focal * baseline / (18 + offset) - z, 1e-9);
  EXPECT_TRUE(check.points[3].rejected);
  const double sigma = std::sqrt(2.0) * z * z * 0.5 / (focal * baseline);
  EXPECT_NEAR(check.points[0].sigma_m / sigma, 1, 1e-6);
  EXPECT_NEAR(check.median_abs_dz_m, std::abs(check.points[1].dz_m),
              1e-12);  // of 0, 1 and 2 pixels; not the rejected one
  EXPECT_NEAR(check.median_ratio, check.points[1].ratio, 1e-12);
}

TEST(DisparityCheck, SaysWhatDoesNotFit) {
  const test::TemporaryFolder folder;
  const Rig rig = rectified();
  const Vectors vectors = reconstruct(pair(rig, 0, 203, 20), rig);
  const auto refuse = [&](const std::string& map, const Rig& with, const std::string& message) {
    BPMS_EXPECT_ERROR(check_disparity(map, vectors, with), ErrorKind::bad_input, message);
  };
  refuse(ramp(folder, 100), rig, "d.png: the disparity map has 100x240 pixels, camera 'left' 320x240");
  refuse(folder.write("no.png", "no picture"), rig, "no.png: not an image that can be decoded");
  const std::string map = ramp(folder);
  Rig other = rig;
  other.cameras[1].parameters[4] = 0.1;
  refuse(map, other, "lens distortion");
  other = rig;
  other.cameras[1].parameters[0] = other.cameras[1].parameters[0] + 1;
  refuse(map, other, "focal lengths differ");
  other = rig;
  other.cameras[1].t_cam_from_rig_m.y() = 0.01;
  refuse(map, other, "the baseline is not along x");
  other = rig;
  other.cameras.pop_back();
  refuse(map, other, "the rig has 1 cameras");
}

}  // namespace
}  // namespace bpms
