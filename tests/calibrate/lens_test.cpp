// Lens models beyond Brown-Conrady against other programs, central differences and themselves.
#include "calibrate/lenses/lens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "calibrate/calibrate.h"
#include "calibrate/lenses/enrich.h"
#include "calibrate/valid_region.h"
#include "core/random.h"
#include "core/units.h"

namespace bpms {
namespace {

Camera brown_camera() {
  Camera camera;
  camera.name = "left";
  camera.width_px = 640;
  camera.height_px = 480;
  camera.parameters = {533.83, 534.1, 342.5, 234.82, -0.2871, 0.0902, 0.00119, -0.00022};
  return camera;
}

Camera fisheye_camera() {
  Camera camera = brown_camera();
  camera.model = "fisheye";
  camera.parameters = {205, 206.5, 322, 237, 0.03, -0.012, 0.005, -0.0007};
  return camera;
}

Camera splined_camera(int order) {
  Camera camera = brown_camera();
  camera.model = "splined_stereographic";
  camera.constants = {static_cast<double>(order), 12, 9, 80};
  camera.parameters.assign(4 + 2 * 12 * 9, 0);
  camera.parameters[0] = 500, camera.parameters[1] = 510;
  camera.parameters[2] = 320, camera.parameters[3] = 240;
  for (std::size_t i = 0; i + 4 < camera.parameters.size(); ++i)
    camera.parameters[i + 4] = 0.01 * std::sin(1.7 * static_cast<double>(i));
  return camera;
}

// A lens of each model with random numbers that is sound over its image.
Camera random_camera(const std::string& choice, Philox& random) {
  Camera camera = brown_camera();
  for (int i = 0; i < 4; ++i) camera.parameters[static_cast<std::size_t>(i)] += random.uniform(-20, 20);
  if (choice == "fisheye") {
    camera.model = "fisheye";
    camera.parameters[0] = random.uniform(205, 400);  // the image corners up to 115 degrees away
    camera.parameters[1] = camera.parameters[0] * random.uniform(0.99, 1.01);
    for (const int i : {4, 5, 6, 7})
      camera.parameters[static_cast<std::size_t>(i)] = random.uniform(-0.01, 0.01) / std::pow(4, i - 4);
    return camera;
  }
  camera.parameters[4] = random.uniform(-0.3, 0.2);
  camera.parameters[5] = random.uniform(0, 0.1);
  if (choice.starts_with("splined")) {
    camera = enriched(camera, lens_choice(choice));
    for (std::size_t i = 4; i < camera.parameters.size(); ++i)
      camera.parameters[i] += random.uniform(-0.004, 0.004);
    return camera;
  }
  camera.parameters.resize(static_cast<std::size_t>(lens_choice(choice).parameters), 0.01);
  return camera;
}

void expect_derivatives(const Camera& camera, const Eigen::Vector3d& x) {
  const Lens& lens = *find_lens(camera.model);
  const auto at = lens.project_with_derivatives({camera.parameters, camera.constants}, x);
  ASSERT_TRUE(at) << x.transpose();
  EXPECT_LT((at->pixel - *project(camera, x)).norm(), 1e-10);
  constexpr double h = 1e-6,
                   tolerance = 2e-5;  // h^2 times third derivatives of some 1e3..1e5 px, and rounding / h
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(i);
    const Eigen::Vector2d d = (*project(camera, x + step) - *project(camera, x - step)) / (2 * h);
    EXPECT_LT((at->by_x_cam.col(i) - d).norm(), tolerance) << i << " at " << x.transpose();
  }
  for (std::size_t i = 0; i < camera.parameters.size(); ++i) {
    Camera more = camera, less = camera;
    more.parameters[i] += h;
    less.parameters[i] -= h;
    const Eigen::Vector2d d = (*project(more, x) - *project(less, x)) / (2 * h);
    EXPECT_LT((at->by_parameters.col(static_cast<Eigen::Index>(i)) - d).norm(), tolerance) << i;
  }
}

TEST(Fisheye, ProjectsAsOpenCvDoes) {
  const Camera camera = fisheye_camera();
  const std::vector<double>& p = camera.parameters;
  const cv::Matx33d k(p[0], 0, p[2], 0, p[1], p[3], 0, 0, 1);
  const cv::Vec4d d(p[4], p[5], p[6], p[7]);
  for (const Eigen::Vector3d& x : {Eigen::Vector3d(0.3, -0.2, 1), {2, 1, 0.5}, {-4, 0.1, 0.3}, {0, 0, 2}}) {
    std::vector<cv::Point2d> theirs;
    cv::fisheye::projectPoints(std::vector<cv::Point3d>{{x.x(), x.y(), x.z()}}, theirs, cv::Vec3d(),
                               cv::Vec3d(), k, d);
    const auto ours = project(camera, x);
    ASSERT_TRUE(ours);
    EXPECT_NEAR(ours->x(), theirs[0].x, 1e-9) << x.transpose();
    EXPECT_NEAR(ours->y(), theirs[0].y, 1e-9) << x.transpose();
  }
}

TEST(Fisheye, SeesBeyond90Degrees) {
  Camera camera = fisheye_camera();
  camera.parameters = {200, 200, 320, 240, 0, 0, 0, 0};  // equidistant
  for (const double theta_deg : {0.0, 45.0, 90.0, 100.0, 120.0}) {
    const double theta = radians(theta_deg);
    const auto pixel = project(camera, {3 * std::sin(theta), 0, 3 * std::cos(theta)});
    ASSERT_TRUE(pixel) << theta_deg;
    EXPECT_NEAR(pixel->x(), 320 + 200 * theta, 1e-10);
    EXPECT_NEAR(pixel->y(), 240, 1e-10);
    const auto ray = unproject(camera, *pixel);
    ASSERT_TRUE(ray);
    EXPECT_NEAR(std::atan2(ray->x(), ray->z()), theta, 1e-12);
  }
  EXPECT_FALSE(project(camera, {0, 0, -1}));  // no direction from the axis
}

TEST(Fisheye, DerivativesAgreeWithCentralDifferences) {
  for (const Eigen::Vector3d& x :
       {Eigen::Vector3d(0.12, -0.2, 0.9), {0.8, 0.5, 0.1}, {0.6, -0.7, -0.1}, {0, 0, 1}})
    expect_derivatives(fisheye_camera(), x);
}

// theta (1 + k1 theta^2) turns back where 1 + 3 k1 theta^2 = 0.
TEST(Fisheye, StopsWhereTheAngleTurnsBack) {
  Camera camera = fisheye_camera();
  camera.parameters = {200, 200, 320, 240, -0.3, 0, 0, 0};
  const double turn = std::sqrt(1 / 0.9), largest = turn * (1 - 0.3 * turn * turn);
  EXPECT_TRUE(project(camera, {std::sin(turn * 0.9999), 0, std::cos(turn * 0.9999)}));
  EXPECT_FALSE(project(camera, {std::sin(turn * 1.0001), 0, std::cos(turn * 1.0001)}));
  EXPECT_TRUE(unproject(camera, {320 + 200 * largest * 0.9999, 240}));
  EXPECT_FALSE(unproject(camera, {320 + 200 * largest * 1.001, 240}));
}

// Pixels that mrcal 2.2 gave for the same numbers (LENSMODEL_SPLINED_STEREOGRAPHIC, 12x9 knots, 80 degrees).
TEST(Splined, ProjectsAsMrcalDoes) {
  const Eigen::Vector3d points[] = {{0.2, -0.1, 1}, {0.5, 0.3, 1}, {-0.4, 0.33, 0.9}, {0, 0, 2}};
  const Eigen::Vector2d cubic[] = {{418.888478631937, 189.541588460646},
                                   {551.904163232855, 381.860778666536},
                                   {113.383420320141, 413.210393460081},
                                   {320.055223158547, 239.819778755961}};
  const Eigen::Vector2d quadratic[] = {{419.450601719172, 189.369182683977},
                                       {551.175007221391, 382.440567175659},
                                       {113.364015481246, 413.395780766344},
                                       {320.099031748266, 239.676809053637}};
  for (int i = 0; i < 4; ++i) {
    EXPECT_LT((*project(splined_camera(3), points[i]) - cubic[i]).norm(), 1e-9) << i;
    EXPECT_LT((*project(splined_camera(2), points[i]) - quadratic[i]).norm(), 1e-9) << i;
  }
}

TEST(Splined, DerivativesAgreeWithCentralDifferences) {
  for (const int order : {2, 3})
    for (const Eigen::Vector3d& x : {Eigen::Vector3d(0.12, -0.2, 0.9), {0.5, 0.31, 1}, {-0.6, -0.37, 1.2}})
      expect_derivatives(splined_camera(order), x);
}

TEST(Splined, IsDefinedOnlyOverItsGrid) {
  const double edge = radians(40.0);  // half of 80 degrees
  for (const int order : {2, 3}) {
    EXPECT_TRUE(project(splined_camera(order), {std::sin(edge * 0.999), 0, std::cos(edge * 0.999)}));
    EXPECT_FALSE(project(splined_camera(order), {std::sin(edge * 1.001), 0, std::cos(edge * 1.001)}));
  }
}

// Without a corner the priors alone determine all but what quadratics have; the rest is the corners'.
TEST(Splined, PriorsLeaveOnlyQuadraticsOpen) {
  const Camera camera = splined_camera(3);
  const Lens& lens = *find_lens(camera.model);
  const LensNumbers numbers{camera.parameters, camera.constants};
  EXPECT_THAT(lens.held(numbers), ::testing::ElementsAre(0, 1, 2, 3));
  const auto n = static_cast<Eigen::Index>(camera.parameters.size()) - 4;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  for (const LensPrior& prior : lens.priors(numbers)) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
    for (const auto& [i, factor] : prior.coefficients) row[i - 4] += factor;
    normal += row * row.transpose();
  }
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(normal, Eigen::EigenvaluesOnly).eigenvalues();
  constexpr double zero = 1e-10;                          // rounding of values up to some hundreds
  EXPECT_EQ((values.array() < zero).count(), 2 * 6 - 3);  // six coefficients each, less the gauge's three
}

class AnyLens : public ::testing::TestWithParam<const char*> {};

TEST_P(AnyLens, UnprojectInvertsProject) {
  Philox random(7);
  for (int lens = 0; lens < 20; ++lens) {
    const Camera camera = random_camera(GetParam(), random);
    ASSERT_EQ(pixel_without_ray(camera), std::nullopt) << lens;
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector2d pixel(random.uniform(0, 639), random.uniform(0, 479));
      const auto ray = unproject(camera, pixel);
      ASSERT_TRUE(ray) << pixel.transpose();
      EXPECT_NEAR(ray->norm(), 1, 1e-14);
      const auto back = project(camera, *ray * 3);
      ASSERT_TRUE(back);
      EXPECT_LT((*back - pixel).norm(), 1e-8);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, AnyLens,
                         ::testing::Values("brown4", "brown5", "brown8", "fisheye", "splined",
                                           "splined:16x12"));

TEST(Enriched, SplineFollowsTheFirstGuess) {
  const Camera before = brown_camera(), after = enriched(before, lens_choice("splined"));
  EXPECT_EQ(after.model, "splined_stereographic");
  double worst = 0;
  for (int u = 0; u < 640; u += 37)
    for (int v = 0; v < 480; v += 41)
      worst = std::max(
          worst, (*project(after, *unproject(before, Eigen::Vector2d(u, v))) - Eigen::Vector2d(u, v)).norm());
  EXPECT_LT(worst, 0.5);  // a start; cubic splines 70 px apart
}

TEST(Enriched, LongerModelStartsWithZeros) {
  const Camera after = enriched(brown_camera(), lens_choice("brown8"));
  ASSERT_EQ(after.parameters.size(), 12u);
  EXPECT_EQ(after.parameters[4], -0.2871);
  EXPECT_THAT(std::vector<double>(after.parameters.begin() + 8, after.parameters.end()),
              ::testing::Each(0.0));
}

TEST(LensChoices, GridOfKnotsCanBeNamed) {
  EXPECT_EQ(lens_choice("splined:16x12").parameters, 4 + 2 * 16 * 12);
  EXPECT_THROW(lens_choice("splined:16"), Error);
  EXPECT_THROW(lens_choice("splined:4x9"), Error);
  EXPECT_THROW(lens_choice("fishey"), Error);
}

// One knot pulled aside folds the surface within few pixels, away from the image's edges.
TEST(Soundness, FindsALocalFold) {
  Camera camera = enriched(brown_camera(), lens_choice("splined"));
  ASSERT_EQ(pixel_without_ray(camera), std::nullopt);
  camera.parameters[4 + 2 * (4 * 12 + 6)] += 0.4;
  EXPECT_NE(pixel_without_ray(camera), std::nullopt);
}

TEST(ValidRegion, IsTheHullOfTheCorners) {
  Observations observations;
  observations.cameras.push_back({"left", 640, 480});
  BoardView view{"left01", 0, "01", {}};
  for (const Eigen::Vector2d& q :
       {Eigen::Vector2d(10, 10), {100, 10}, {50, 40}, {100, 90}, {10, 90}, {10, 50}})
    view.corners.push_back({0, q});
  observations.views.push_back(view);
  const auto hull = valid_region(observations, 0);
  EXPECT_THAT(hull, ::testing::UnorderedElementsAre(Eigen::Vector2d(10, 10), Eigen::Vector2d(100, 10),
                                                    Eigen::Vector2d(100, 90), Eigen::Vector2d(10, 90)));
  EXPECT_TRUE(inside_hull(hull, {50, 40}));
  EXPECT_FALSE(inside_hull(hull, {5, 40}));
  EXPECT_TRUE(valid_region(observations, 1).empty());
}

TEST(RigToml, ReadsBackEveryModel) {
  Philox random(3);
  for (const char* choice : {"fisheye", "splined", "brown8"}) {
    Rig rig;
    rig.cameras.push_back(random_camera(choice, random));
    const std::string path = ::testing::TempDir() + "lens_rig.toml";
    std::FILE* file = std::fopen(path.c_str(), "w");
    std::fputs(rig_toml(rig).c_str(), file);
    std::fclose(file);
    const Rig back = read_rig(path);
    EXPECT_EQ(back.cameras[0].model, rig.cameras[0].model);
    EXPECT_EQ(back.cameras[0].parameters, rig.cameras[0].parameters);
    EXPECT_EQ(back.cameras[0].constants, rig.cameras[0].constants);
  }
}

}  // namespace
}  // namespace bpms
