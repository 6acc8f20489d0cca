// A plant phenotyping cabinet: a board on a turntable before a side camera, one frame of it also seen from
// above (corners clicked to whole pixels there). Published for such cabinets: a mean error of 0.34 px.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "calibrate/calibrate.h"
#include "core/units.h"
#include "tests/data.h"

namespace bpms {
namespace {

Observations cabinet(bool with_top) {
  std::ifstream file(test::data_folder() + "/phenomenal-maize/plant_1/chessboard/points/chessboard_1.json");
  const auto document = nlohmann::json::parse(file);
  Observations out;
  out.cameras = {{"side", 2056, 2454}};
  if (with_top) out.cameras.push_back({"top", 2454, 2056});
  for (std::size_t c = 0; c < out.cameras.size(); ++c) {
    for (const auto& [angle, corners] : document["image_points"][out.cameras[c].name].items()) {
      const std::string frame = fmt::format("{:03}", std::lround(std::stod(angle)));
      BoardView view{out.cameras[c].name + frame, static_cast<int>(c), frame, {}};
      for (std::size_t i = 0; i < corners.size(); ++i)
        view.corners.push_back({static_cast<int>(i), Eigen::Vector2d(corners[i][0][0].get<double>(),
                                                                     corners[i][0][1].get<double>())});
      out.views.push_back(view);
    }
  }
  return out;
}

double mean_error_px(const Calibration& c) {
  double sum = 0;
  int count = 0;
  for (const auto& view : c.views)
    for (const Eigen::Vector4d& r : view.residuals) sum += r.tail<2>().norm(), ++count;
  return sum / count;
}

// Over all corners, those that were left out too.
double mean_of_all_px(const Calibration& c) {
  double sum = mean_error_px(c) * c.corners_used;
  for (const auto& outlier : c.outliers) sum += outlier.residual_px;
  return sum / c.corners_total;
}

TEST(MaizeRig, TurnsAboutOneAxis) {
  BPMS_NEED_DATA("phenomenal-maize/plant_1/chessboard/points/chessboard_1.json");
  const Target board = parse_target("chessboard:8x6:47mm");
  const Calibration c = calibrate(cabinet(true), board, {.lens = "pinhole", .table_step_rad = radians(1.0)});
  ASSERT_TRUE(c.turntable);
  const Calibration::Turntable& table = *c.turntable;
  std::printf(
      "mean %.3f px of the used, %.3f px of all %d corners, rms %.3f px; axis +- %.4f rad, +- %.1f mm; "
      "odd and even angles %.5f rad, %.1f mm apart\n",
      mean_error_px(c), mean_of_all_px(c), c.corners_total, c.residual_rms_px,
      table.direction_sigma_clustered_rad, 1e3 * table.point_sigma_clustered_m,
      table.halves_angle_rad.value(), 1e3 * table.halves_distance_m.value());
  EXPECT_LT(mean_error_px(c), 0.35);
  EXPECT_LT(mean_of_all_px(c), 0.35);
  EXPECT_GT(c.corners_used, 0.9 * c.corners_total);
  // Upright within some degrees: y points down in the camera. The cabinet is 5 to 6 m deep.
  EXPECT_GT(std::abs(table.direction.y()), 0.99);
  EXPECT_NEAR(table.point_m.z(), 5.5, 0.5);
  // Each half has sqrt(2) times the sigma of the whole, their difference twice; 3 of these.
  EXPECT_LT(*table.halves_angle_rad, 6 * table.direction_sigma_clustered_rad);
  EXPECT_LT(*table.halves_distance_m, 6 * table.point_sigma_clustered_m);
  EXPECT_LT(table.direction_sigma_clustered_rad, 0.02);
}

// The sense in which the angles were counted turns the axis over, nothing else.
TEST(MaizeRig, DoesNotCareWhichWayAnglesCount) {
  BPMS_NEED_DATA("phenomenal-maize/plant_1/chessboard/points/chessboard_1.json");
  const Target board = parse_target("chessboard:8x6:47mm");
  const Calibration there =
                        calibrate(cabinet(false), board,
                                  {.lens = "pinhole", .table_step_rad = radians(1.0), .uncertainty = false}),
                    back =
                        calibrate(cabinet(false), board,
                                  {.lens = "pinhole", .table_step_rad = radians(-1.0), .uncertainty = false});
  EXPECT_NEAR(there.residual_rms_px, back.residual_rms_px, 1e-6);
  EXPECT_LT((there.turntable->direction + back.turntable->direction).norm(), 1e-5);
}

}  // namespace
}  // namespace bpms
