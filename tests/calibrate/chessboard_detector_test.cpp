// The detector on rendered boards, whose corners are known exactly, and on the ways in which real sets are
// incomplete.
#include "calibrate/chessboard_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/units.h"
#include "tests/data.h"

namespace bpms {
namespace {

constexpr double focal_px = 500;
constexpr int width = 640, height = 480;

struct View {
  Eigen::Matrix3d r;
  Eigen::Vector3d t_m;
};
View look_at(const Target& target, double roll_deg, double tilt_deg) {
  const Eigen::Matrix3d r = (Eigen::AngleAxisd(radians(tilt_deg), Eigen::Vector3d(1, 0.4, 0).normalized()) *
                             Eigen::AngleAxisd(radians(roll_deg), Eigen::Vector3d::UnitZ()))
                                .toRotationMatrix();
  const Eigen::Vector3d middle((target.columns - 1) * target.square_m / 2,
                               (target.rows - 1) * target.square_m / 2, 0);
  return {r, Eigen::Vector3d(0.011, -0.007, 0.42) - r * middle};
}
Eigen::Vector2d pixel(const View& view, const Eigen::Vector3d& x) {
  const Eigen::Vector3d c = view.r * x + view.t_m;
  return focal_px * c.head<2>() / c.z() + Eigen::Vector2d(320.3, 239.6);
}

// Pixel centres are integers: the samples of a pixel fill -1/2 .. 1/2 about it, on a lattice that has as many
// steps along each axis as it has points.
cv::Mat render(const Target& target, const View& view) {
  Eigen::Matrix3d k, plane;
  k << focal_px, 0, 320.3, 0, focal_px, 239.6, 0, 0, 1;
  plane << view.r.col(0), view.r.col(1), view.t_m;
  const Eigen::Matrix3d from_image = (k * plane).inverse();
  constexpr int samples = 34, stride = 21;  // Fibonacci lattice
  cv::Mat image(height, width, CV_32F);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      double sum = 0;
      for (int i = 0; i < samples; ++i) {
        const Eigen::Vector3d q(u + (i + 0.5) / samples - 0.5,
                                v + (i * stride % samples + 0.5) / samples - 0.5, 1);
        const Eigen::Vector2d x = (from_image * q).hnormalized() / target.square_m;
        const int column = static_cast<int>(std::floor(x.x())), row = static_cast<int>(std::floor(x.y()));
        const bool inside = column >= -1 && row >= -1 && column < target.columns && row < target.rows;
        sum += inside && (column + row) % 2 == 0 ? 30 : 220;
      }
      image.at<float>(v, u) = static_cast<float>(sum / samples);
    }
  }
  cv::Mat blurred, out;
  cv::GaussianBlur(image, blurred, cv::Size(7, 7), 0.7);
  blurred.convertTo(out, CV_8U);
  return out;
}

Target make_target(int columns, int rows) {
  Target target;
  target.columns = columns, target.rows = rows, target.square_m = 0.02;
  return target;
}

class Rendered : public ::testing::TestWithParam<double> {};
TEST_P(Rendered, CornersAreWhereTheyWereDrawnAndInTheBoardsOrder) {
  const Target target = make_target(9, 6);
  const View view = look_at(target, GetParam(), 30);
  const auto corners = find_chessboard(render(target, view), target);
  ASSERT_TRUE(corners);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double square = 0;
  for (std::size_t i = 0; i < corners->size(); ++i) {
    const Eigen::Vector2d off = (*corners)[i] - pixel(view, target.points_m()[i]);
    mean += off / 54;
    square += off.squaredNorm() / 54;
  }
  EXPECT_LT(mean.norm(), 0.02);  // a convention of half pixels would give 0.7
  EXPECT_LT(std::sqrt(square / 2), 0.04);
}
// Any roll: the colours of a 9x6 board tell its ends apart.
INSTANTIATE_TEST_SUITE_P(Rolls, Rendered, ::testing::Values(0.0, 30.0, 90.0, 180.0, 250.0));

TEST(Detector, CamerasOfAFrameAgreeOnABoardThatHalfATurnLeavesAlike) {
  const test::TemporaryFolder folder;
  const Target target = make_target(8, 6);
  std::vector<std::string> files;
  for (const auto& [name, roll] :
       {std::pair{"left1.png", 2.0}, {"right1.png", -60.0}, {"left2.png", 178.0}, {"right2.png", 120.0}}) {
    files.push_back(folder / name);
    cv::imwrite(files.back(), render(target, look_at(target, roll, 25)));
  }
  const Observations found = find_corners(files, target);
  ASSERT_EQ(found.views.size(), 4u);
  for (const std::size_t v : {0u, 2u}) {
    const BoardView &left = found.views[v], &right = found.views[v + 1];
    ASSERT_EQ(left.frame, right.frame);
    Eigen::Vector2d along[2];
    for (int c = 0; c < 2; ++c) {
      const BoardView& view = c ? right : left;
      for (const ImageCorner& corner : view.corners) {
        if (corner.point == 0) along[c] -= corner.pixel;
        if (corner.point == 7) along[c] += corner.pixel;
      }
    }
    // In both the row runs from the same end: 62 degrees apart as drawn, not 118.
    EXPECT_GT(along[0].normalized().dot(along[1].normalized()), 0.2);
  }
}

TEST(Detector, NamesWhatItSkips) {
  const test::TemporaryFolder folder;
  const Target target = make_target(9, 6);
  for (int i = 1; i <= 3; ++i)
    cv::imwrite(folder / fmt::format("left{}.png", i), render(target, look_at(target, 0, 10 * i)));
  cv::imwrite(folder / "left4.png", cv::Mat(height, width, CV_8U, cv::Scalar(90)));
  cv::Mat small;
  cv::resize(render(target, look_at(target, 0, 20)), small, cv::Size(320, 240));
  cv::imwrite(folder / "left5.png", small);
  folder.write("left6.png", "no image");
  const std::vector<std::string> files = expand_patterns(
      {folder / "left[0-9].png", folder / "left7.png", folder / "up*.png", folder / "left.png"});
  ASSERT_EQ(files.size(), 9u);
  const Observations found = find_corners(files, target);
  EXPECT_EQ(found.views.size(), 3u);
  ASSERT_EQ(found.skipped.size(), 6u);
  const char* const reasons[] = {
      "no whole 9x6 chessboard", "320x240 pixels",       "cannot be read as an image", "no such file",
      "no file matches",         "no digits in the name"};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_THAT(found.skipped[i].reason, ::testing::HasSubstr(reasons[i]));
}

TEST(Detector, RefusesTwoImagesOfOneMoment) {
  const test::TemporaryFolder folder;
  const Target target = make_target(9, 6);
  for (const char* name : {"left1.png", "left1.bmp"})
    cv::imwrite(folder / name, render(target, look_at(target, 0, 20)));
  BPMS_EXPECT_ERROR(find_corners({folder / "left1.png", folder / "left1.bmp"}, target), ErrorKind::bad_input,
                    "second image of frame 1");
}

}  // namespace
}  // namespace bpms
