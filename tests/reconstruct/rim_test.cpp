#include "reconstruct/points/rim.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "tests/data.h"
#include "tests/reconstruct/synthetic.h"

namespace bpms {
namespace {

constexpr double diameter = 0.16, pi_over_2 = pi / 2;
const Eigen::Vector3d centre(0.02, 0.08, 1.5), up = Eigen::Vector3d(0.05, -1, -0.3).normalized();

// Points on an arc of the rim towards the camera, each off the circle by a normal error of `roughness` per
// axis.
Vectors rim_points(const Rig& nominal, const Rig& truth, int count, double arc_rad, double sigma_px,
                   double roughness, Philox* random) {
  const Eigen::Vector3d e1 = up.cross(Eigen::Vector3d::UnitZ()).normalized(), e2 = up.cross(e1);
  std::vector<ImagePoint> rows;
  for (int i = 0; i < count; ++i) {
    const double angle = -pi_over_2 + arc_rad * (static_cast<double>(i) / (count - 1) - 0.5);
    Eigen::Vector3d x = centre + diameter / 2 * (std::cos(angle) * e1 - std::sin(angle) * e2);
    if (random != nullptr)
      x += roughness * Eigen::Vector3d(random->normal(), random->normal(), random->normal());
    for (ImagePoint p : test::image_points(nominal, i, test::sight(truth, x, sigma_px, random))) {
      p.label.organ = "pot";
      p.label.feature = "outline";
      rows.push_back(p);
    }
  }
  return reconstruct(rows, nominal, {0, true, {}});
}

TEST(Rim, IsExactWithoutNoise) {
  const Rig rig = test::parallel_rig();
  for (const double arc : {1.5, 3.0, 6.0}) {
    const Rim rim =
        fit_rim(pot_outline(rim_points(rig, rig, 12, arc, 0.5, 0, nullptr)), {}, -Eigen::Vector3d::UnitY());
    EXPECT_NEAR(rim.diameter_m, diameter, 1e-8);
    EXPECT_LT((rim.normal - up).norm(), 1e-7);
    EXPECT_LT((rim.centre_m - centre).norm(), 1e-8);
    EXPECT_EQ(rim.roughness_m, 0);
    EXPECT_NEAR(rim.tilt_rad, std::acos(-up.y()), 1e-7);
    EXPECT_EQ(rim.dof, 18);
  }
}

TEST(Rim, SigmasAreTrue) {
  constexpr int trials = 1000;
  Rig rig = test::parallel_rig();
  test::give_covariance(rig, 0.3, 90);
  Philox random(91);
  double squares = 0, normal_squares = 0, chi2 = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const Vectors vectors = rim_points(rig, rig, 14, 4.0, 0.3, 0, &random);
    const Rim rim = fit_rim(pot_outline(vectors), {}, -Eigen::Vector3d::UnitY());
    squares += std::pow((rim.diameter_m - diameter) / rim.diameter_sigma_m, 2) / trials;
    normal_squares += (rim.normal - up).squaredNorm() / std::pow(rim.normal_sigma_rad, 2) / trials;
    chi2 += rim.chi2 / rim.dof / trials;
  }
  const double three_errors = 3 * std::sqrt(2.0 / trials);
  // Where chi-square exceeds its degrees of freedom by chance, some roughness is taken for real: sigmas are a
  // little too large rather than too small.
  EXPECT_LT(squares, 1 + three_errors);
  EXPECT_GT(squares, 0.8 - three_errors);
  EXPECT_LT(normal_squares, 1 + three_errors * 1.5);
  EXPECT_GT(normal_squares, 0.8 - three_errors * 1.5);
}

TEST(Rim, RigErrorsDoNotAverageOut) {
  // A baseline in error by 1 % scales everything: the diameter's sigma is 1 % of it, whatever the number of
  // points.
  Rig rig = test::parallel_rig();
  const double sigma_b = 0.01 * test::parallel_baseline_m;
  rig.covariance = Rig::Covariance{{"right.tx"}, Eigen::MatrixXd::Constant(1, 1, sigma_b * sigma_b), "iid"};
  const Vectors vectors = rim_points(rig, rig, 200, 6.0, 1e-3, 0, nullptr);
  const Rim rim = fit_rim(pot_outline(vectors), rig.covariance->matrix, -Eigen::Vector3d::UnitY());
  EXPECT_NEAR(rim.diameter_sigma_m / diameter, 0.01, 1e-4);
}

TEST(Rim, RoughnessIsEstimated) {
  const Rig rig = test::parallel_rig();
  Philox random(92);
  constexpr double roughness = 1e-3;
  constexpr int trials = 200;
  double mean = 0, squares = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const Rim rim = fit_rim(pot_outline(rim_points(rig, rig, 40, 5.0, 0.1, roughness, &random)), {},
                            -Eigen::Vector3d::UnitY());
    mean += rim.roughness_m / trials;
    squares += std::pow((rim.diameter_m - diameter) / rim.diameter_sigma_m, 2) / trials;
  }
  EXPECT_NEAR(mean / roughness, 1, 0.05);
  EXPECT_NEAR(squares, 1, 3 * std::sqrt(2.0 / trials));
}

TEST(Rim, TooLittleIsSaid) {
  const Rig rig = test::parallel_rig();
  BPMS_EXPECT_ERROR(fit_rim(pot_outline(rim_points(rig, rig, 3, 3.0, 0.5, 0, nullptr)), {}, up),
                    ErrorKind::bad_input, "3 accepted points labelled organ 'pot', feature 'outline'");
  Philox random(93);
  BPMS_EXPECT_ERROR(fit_rim(pot_outline(rim_points(rig, rig, 10, 0.1, 1.0, 0, &random)), {}, up),
                    ErrorKind::numeric, "circle");
}

}  // namespace
}  // namespace bpms
