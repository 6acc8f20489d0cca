// Targets in real photographs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "calibrate/adjustment/homography.h"
#include "calibrate/images/image_file.h"
#include "calibrate/targets/tag_detector.h"
#include "calibrate/targets/target_kind.h"
#include "tests/data.h"

namespace bpms {
namespace {

// How far the points lie from the homography of the board that fits best, rms per axis.
double off_a_plane_px(const Target& target, const Detection& found) {
  std::vector<Eigen::Vector2d> plane, image;
  const std::vector<Eigen::Vector3d> points = target.points_m();
  for (const ImageCorner& corner : found.corners) {
    plane.emplace_back(points[static_cast<std::size_t>(corner.point)].head<2>());
    image.push_back(corner.pixel);
  }
  const auto h = homography(plane, image);
  if (!h) return HUGE_VAL;
  double sum = 0;
  for (std::size_t i = 0; i < plane.size(); ++i)
    sum += ((*h * plane[i].homogeneous()).hnormalized() - image[i]).squaredNorm();
  return std::sqrt(sum / (2 * static_cast<double>(plane.size())));
}

struct Photograph {
  const char *name, *path, *spec;
  std::size_t fewest;
  double plane_px;  // lens distortion keeps real boards off a homography
};
void PrintTo(const Photograph& p, std::ostream* out) {
  *out << p.path;
}

class Photographed : public ::testing::TestWithParam<Photograph> {};
TEST_P(Photographed, IsFound) {
  BPMS_NEED_DATA(GetParam().path);
  const Target target = parse_target(GetParam().spec);
  const ImageFile file = read_image_file(test::data_folder() + "/" + GetParam().path);
  ASSERT_EQ(file.trouble, "");
  const Detection found = detect_target(file.grey, target);
  fmt::print("{}: {} of {} points, {:.3f} px off a plane {}{}\n", GetParam().path, found.corners.size(),
             target.size(), off_a_plane_px(target, found), found.trouble, fmt::join(found.remarks, "; "));
  EXPECT_GE(found.corners.size(), GetParam().fewest) << found.trouble;
  EXPECT_LT(off_a_plane_px(target, found), GetParam().plane_px);
}
INSTANTIATE_TEST_SUITE_P(
    Of, Photographed,
    ::testing::Values(Photograph{"Charuco", "opencv-doc/charuco/choriginal.jpg",
                                 "charuco:5x7:40mm:20mm:DICT_6X6_250", 20, 1},
                      Photograph{"KalibrCheckerboard", "calib-misc/kalibr/testImageCheckerboard.jpg",
                                 "chessboard:8x9:60mm", 72, 5},
                      Photograph{"KalibrCircles", "calib-misc/kalibr/testImageCircleGrid.jpg",
                                 "circles:7x5:20mm:10mm", 35, 3}),
    [](const ::testing::TestParamInfo<Photograph>& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace bpms
