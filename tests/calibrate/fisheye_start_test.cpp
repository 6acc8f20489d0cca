// Fisheye calibrations with boards up to the edge of a field of 180 degrees, from nothing but corners.
#include "calibrate/lenses/fisheye_start.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "calibrate/adjustment/synthetic.h"
#include "calibrate/calibrate.h"
#include "core/random.h"
#include "core/units.h"
#include "tests/calibrate/errors.h"

namespace bpms {
namespace {

// Boards all around a camera that sees 180 degrees across, each corner within 88 degrees of the axis.
SyntheticCalibration wide_scene(int frames) {
  SyntheticCalibration out;
  out.target.columns = 9, out.target.rows = 6, out.target.square_m = 0.025;
  Camera camera;
  camera.name = "wide";
  camera.width_px = 640, camera.height_px = 640;
  camera.model = "fisheye";
  camera.parameters = {200, 201, 321, 317, 0.02, -0.008, 0.003, -0.0006};
  BundleProblem board = out.problem();
  board.frames = frames;
  out.truth = empty_state(board, {camera});
  Philox random(5);
  const Eigen::Vector3d middle(0.1, 0.0625, 0);
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(frames);) {
    const double theta = radians(random.uniform(0, 75)), towards = random.uniform(0, 2 * pi);
    const Eigen::Vector3d direction(std::sin(theta) * std::cos(towards), std::sin(theta) * std::sin(towards),
                                    std::cos(theta));
    const Eigen::Matrix3d facing =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), direction).toRotationMatrix();
    const double tilt = radians(random.uniform(10, 35)), about = random.uniform(0, 2 * pi);
    const Eigen::Matrix3d r =
        facing * rotation_from_vector(tilt * Eigen::Vector3d(std::cos(about), std::sin(about), 0));
    const Pose pose{r, random.uniform(0.2, 0.4) * direction - r * middle};
    bool seen = true;
    for (const Eigen::Vector3d& x : out.target.points_m()) {
      const Eigen::Vector3d in_camera = pose * x;
      const auto pixel = project(camera, in_camera);
      seen = seen && pixel && (pixel->array() > 1).all() && (pixel->array() < 638).all() &&
             std::atan2(in_camera.head<2>().norm(), in_camera.z()) < radians(88.0);
    }
    if (seen) out.truth.world_from_target[0][frame++] = pose;
  }
  return out;
}

TEST(FisheyeStart, FindsFocalLengthAndPoses) {
  const SyntheticCalibration scene = wide_scene(15);
  const Observations seen = observe(scene, 0.1, 1);
  std::vector<FlatView> views;
  for (const BoardView& view : seen.views) {
    views.emplace_back();
    for (const ImageCorner& corner : view.corners) {
      views.back().points_m.push_back(scene.target.points_m()[static_cast<std::size_t>(corner.point)]);
      views.back().pixels.push_back(corner.pixel);
    }
  }
  const auto start = fisheye_start(views, 640, 640);
  ASSERT_TRUE(start);
  EXPECT_NEAR(start->focal_px, 200, 10);  // the lens is not equidistant, its centre not the image's
  for (std::size_t f = 0; f < views.size(); ++f) {
    ASSERT_TRUE(start->camera_from_target[f]);
    const Pose& found = *start->camera_from_target[f];
    const Pose& truth = scene.truth.world_from_target[0][f];
    EXPECT_LT(vector_from_rotation(found.r * truth.r.transpose()).norm(), radians(10.0)) << f;
    EXPECT_LT((found.t_m - truth.t_m).norm(), 0.1 * truth.t_m.norm()) << f;
  }
}

// Exact rays give the exact pose, also beyond 90 degrees from the axis.
TEST(PoseFromRays, IsExact) {
  const Pose truth{rotation_from_vector({0.3, 1.6, -0.4}), {0.5, 0.1, 0.02}};
  std::vector<Eigen::Vector2d> plane;
  std::vector<Eigen::Vector3d> rays;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 4; ++j) {
      plane.emplace_back(0.1 * i, 0.07 * j);
      rays.push_back((truth * Eigen::Vector3d(0.1 * i, 0.07 * j, 0)).normalized());
    }
  }
  const auto pose = pose_from_rays(plane, rays);
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->r - truth.r).norm(), 1e-8);
  EXPECT_LT((pose->t_m - truth.t_m).norm(), 1e-8);
  EXPECT_FALSE(pose_from_rays({plane.begin(), plane.begin() + 3}, {rays.begin(), rays.begin() + 3}));
}

TEST(FisheyeCalibration, FindsTheTruthFromNothing) {
  const SyntheticCalibration scene = wide_scene(15);
  const Calibration c =
      calibrate(observe(scene, 0, 1), scene.target, {.lens = "fisheye", .uncertainty = false});
  EXPECT_LT(c.residual_rms_px, 1e-9);
  EXPECT_EQ(c.corners_used, c.corners_total);
  EXPECT_LT(test::errors(c.rig.cameras, scene.truth.cameras).cwiseAbs().maxCoeff(), 1e-7);
}

// The squared error in units of the covariance is chi-squared with 8 degrees of freedom.
TEST(FisheyeCalibration, ErrsAsItsCovarianceSays) {
  const SyntheticCalibration scene = wide_scene(15);
  double sum = 0;
  constexpr int runs = 20;
  for (int run = 0; run < runs; ++run) {
    const Calibration c = calibrate(observe(scene, 0.1, static_cast<std::uint64_t>(run + 1)), scene.target,
                                    {.lens = "fisheye", .uncertainty = false});
    const Eigen::VectorXd off = test::errors(c.rig.cameras, scene.truth.cameras);
    sum += off.dot(c.rig.covariance->matrix.ldlt().solve(off));
  }
  EXPECT_NEAR(sum / runs, 8, 4 * std::sqrt(2 * 8.0 / runs));  // 4 standard errors
}

}  // namespace
}  // namespace bpms
