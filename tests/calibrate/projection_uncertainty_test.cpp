#include "calibrate/projection_uncertainty.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "calibrate/adjustment/synthetic.h"
#include "calibrate/calibrate.h"
#include "core/random.h"

namespace bpms {
namespace {

// A camera that was only turned and moved is the same camera.
TEST(ProjectionDifference, OfAMovedCameraIsNone) {
  const Camera camera = synthetic_calibration({}).truth.cameras[0];
  for (const double range : {0.0, 0.5, 3.0}) {
    const ProjectionMap map = projection_difference(camera, camera, {.range_m = range});
    EXPECT_LT(map.quantile(1), 1e-9) << range;
    EXPECT_EQ(map.px.size(), 32u * 24u);
  }
}

// A principal point that is wrong by some pixels is nearly a turn: what stays is the part that no turn makes
// up for. To first order the direct difference of both projections, turned back, tells how much.
TEST(ProjectionDifference, TakesOffWhatATurnExplains) {
  Camera camera = synthetic_calibration({}).truth.cameras[0], other = camera;
  other.parameters[2] += 3;
  const ProjectionMap map = projection_difference(camera, other, {.range_m = 0});
  EXPECT_LT(map.quantile(0.5), 1);
  EXPECT_GT(map.quantile(1), 0.01);
  other = camera;
  other.parameters[0] *= 1.01,
      other.parameters[1] *= 1.01;  // no turn does that: 1 % of the distance to the axis
  const ProjectionMap zoomed = projection_difference(camera, other, {.range_m = 0});
  const double corner =
      std::hypot(zoomed.x_px[0] - camera.parameters[2], zoomed.y_px[0] - camera.parameters[3]);
  EXPECT_NEAR(zoomed.px[0], 0.01 * corner, 0.002 * corner);
}

// A lens that runs wild at the image's corners does not tilt the comparison of the rest.
TEST(ProjectionDifference, TheMiddleDecides) {
  Camera camera = synthetic_calibration({}).truth.cameras[0], other = camera;
  camera.parameters.resize(9), other.parameters.resize(9);
  other.parameters[8] += 0.2;  // f r^7: 0.02 px at 160 px from the axis, 14 px at 400 px
  const ProjectionMap map = projection_difference(camera, other, {.range_m = 0.5});
  EXPECT_GT(map.quantile(1), 5);
  // A quarter of the image lies within 160 px. Part of the middle range is traded in; a plain least squares
  // fit would spread 1.6 px there.
  EXPECT_LT(map.quantile(0.25), 0.4);
}

// The same lenses compared over the region where they agree: there the difference is what it is.
TEST(ProjectionDifference, CountsTheRegionAlone) {
  Camera camera = synthetic_calibration({}).truth.cameras[0], other = camera;
  camera.parameters.resize(9), other.parameters.resize(9);
  other.parameters[8] += 0.2;
  const double cx = camera.parameters[2], cy = camera.parameters[3], r = 120;
  const ProjectionMap map = projection_difference(
      camera, other,
      {.range_m = 0.5, .region = {{cx - r, cy - r}, {cx - r, cy + r}, {cx + r, cy + r}, {cx + r, cy - r}}});
  const auto at = [&](std::size_t column, std::size_t row) { return map.px[row * 32 + column]; };
  EXPECT_LT(at(16, 12), 0.01);  // within the region 107 px (170/535)^7 = 0.03 px at most
  EXPECT_LT(at(12, 9), 0.02);
  EXPECT_GT(at(0, 0), 5);
}

// Lenses drawn from the covariance differ from their mean by what the map says: the squared difference over
// the variance, averaged over draws and pixels. A Gaussian ellipse has E|d|^2 = s1^2 + s2^2, between one and
// two times the larger variance.
TEST(ProjectionUncertainty, IsTheSpreadOfProjections) {
  const SyntheticCalibration scene = synthetic_calibration({.frames = 12});
  const Calibration c = calibrate(observe(scene, 0.1, 3), scene.target, {.uncertainty = false});
  const Camera& camera = c.rig.cameras[0];
  const Eigen::MatrixXd covariance = lens_covariance(*c.rig.covariance, camera);
  const MapOptions options{.range_m = 0.5, .columns = 8, .rows = 6};
  const ProjectionMap map = projection_uncertainty(camera, covariance, options);
  const Eigen::MatrixXd factor = covariance.llt().matrixL();
  Philox random(5);
  constexpr int draws = 400;
  std::vector<double> square(map.px.size(), 0);
  for (int k = 0; k < draws; ++k) {
    Eigen::VectorXd z(factor.rows());
    for (double& v : z) v = random.normal();
    Camera drawn = camera;
    const Eigen::VectorXd change = factor * z;
    for (std::size_t i = 0; i < drawn.parameters.size(); ++i)
      drawn.parameters[i] += change[static_cast<Eigen::Index>(i)];
    const ProjectionMap off = projection_difference(camera, drawn, options);
    for (std::size_t i = 0; i < square.size(); ++i) square[i] += off.px[i] * off.px[i] / draws;
  }
  // Of 400 draws a variance is known to sqrt(2/400) = 7 %; 4 of these.
  for (std::size_t i = 0; i < square.size(); ++i) {
    const double ratio = square[i] / (map.px[i] * map.px[i]);
    EXPECT_GT(ratio, 1 - 0.28) << i;
    EXPECT_LT(ratio, 2 * (1 + 0.28)) << i;
  }
}

// Far from where the boards were, near the lens, and at the image's corners a lens is known worse.
TEST(ProjectionUncertainty, GrowsTowardsTheCorners) {
  const SyntheticCalibration scene = synthetic_calibration({.frames = 12});
  const Calibration c = calibrate(observe(scene, 0.1, 3), scene.target, {.uncertainty = false});
  const ProjectionMap map = projection_uncertainty(
      c.rig.cameras[0], lens_covariance(*c.rig.covariance, c.rig.cameras[0]), {.range_m = 0.5});
  EXPECT_GT(map.px[0], 2 * map.quantile(0.2));
  EXPECT_GT(map.quantile(0.1), 0);
}

}  // namespace
}  // namespace bpms
