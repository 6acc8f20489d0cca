// The forward model of the midrib against closed forms.
#include "plant/leaf_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

OrganAttributes arching(double tip_deg, double length = 10) {
  OrganAttributes leaf;
  leaf.length_m = length;
  leaf.f_inclination = make_organ_function('n', {0, 0, 1, tip_deg}, radians(1), {});
  return leaf;
}

TEST(OrganRotation, TangentIsTheStatedVector) {
  for (const double i : {-2.0, 0.3, 1.9}) {
    for (const double a : {-0.7, 0.0, 1.1}) {
      for (const double t : {0.0, 2.2}) {
        const Eigen::Matrix3d r = organ_rotation(i, a, t);
        const Eigen::Vector3d z(std::cos(a) * std::sin(i), -std::sin(a), std::cos(a) * std::cos(i));
        EXPECT_LT((r.col(2) - z).norm(), 1e-15);
        EXPECT_LT((r.col(0).cross(r.col(1)) - r.col(2)).norm(), 1e-15);  // right-handed
      }
    }
  }
}

TEST(OrganRotation, EachAngleTurnsTheStatedWay) {
  const double quarter = pi / 2;
  EXPECT_LT((organ_rotation(quarter, 0, 0).col(2) - Eigen::Vector3d::UnitX()).norm(),
            1e-15);  // leans outward
  EXPECT_LT((organ_rotation(0, quarter, 0).col(2) + Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((organ_rotation(0, 0, quarter).col(0) - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  // Azimuth turns about the local leaf normal: with the leaf lying along x, it sweeps in the horizontal
  // plane.
  EXPECT_NEAR(organ_rotation(quarter, 0.4, 0).col(2).z(), 0, 1e-15);
}

TEST(Midrib, EndPointsOfLinearInclination) {
  struct Case {
    double tip_deg, x, z;
  };
  for (const Case& c :
       {Case{45, 3.72923, 9.00316}, {90, 6.36620, 6.36620}, {135, 7.24519, 3.00105}, {180, 6.36620, 0}}) {
    const MidribPoint tip = midrib(arching(c.tip_deg), {0, 0.5, 1}).back();
    EXPECT_NEAR(tip.x_m.x(), c.x, 5.1e-6) << c.tip_deg;
    EXPECT_NEAR(tip.x_m.y(), 0, 1e-12);
    EXPECT_NEAR(tip.x_m.z(), c.z, 5.1e-6) << c.tip_deg;
    const double k = radians(c.tip_deg);
    EXPECT_NEAR(tip.x_m.x(), 10 * (1 - std::cos(k)) / k, 1e-8);
    EXPECT_NEAR(tip.x_m.z(), 10 * std::sin(k) / k, 1e-8);
  }
}

TEST(Midrib, IsAccurateForEveryKindOfFunction) {
  struct Case {
    char inclination;
    std::vector<double> i_numbers;
    char azimuth;
    std::vector<double> a_numbers;
  };
  for (const Case& c : {Case{'n', {0, 0, 0.31, 170, 1, 20}, 'p', {0, 40, -90}},
                        Case{'p', {15, 40, 30, -200, 100}, 'f', {5, 10, -20, 3}},
                        Case{'f', {60, -45, 20, 10, 5, 90}, 's', {0, 0, 0.2, 30, 1, -60}},
                        Case{'s', {0, 10, 0.5, 400, 0.6, 0, 1, 90}, 'n', {0, 0, 0.77, 90, 1, 0}}}) {
    OrganAttributes leaf;
    leaf.length_m = 1;
    leaf.f_inclination = make_organ_function(c.inclination, c.i_numbers, radians(1), {});
    leaf.f_azimuth = make_organ_function(c.azimuth, c.a_numbers, radians(1), {});
    // Simpson's rule on a fine grid that holds every knot (steps of 1e-4).
    const int n = 20000;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i <= n; ++i) {
      const double weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2;
      sum += weight * organ_frame(leaf, static_cast<double>(i) / n).col(2);
    }
    EXPECT_LT((midrib(leaf, {1}).back().x_m - sum / (3.0 * n)).norm(), 1e-9) << c.inclination;
    // The same place, whatever stops are asked for on the way.
    EXPECT_LT((midrib(leaf, {0.1, 0.2, 0.8, 1}).back().x_m - midrib(leaf, {1}).back().x_m).norm(), 1e-9);
  }
}

TEST(Midrib, WithoutFunctionsIsStraight) {
  OrganAttributes stem;
  stem.length_m = 0.12;
  stem.f_twist = make_organ_function('n', {0, 0, 1, 90}, radians(1), {});
  const MidribPoint tip = midrib(stem, {1}).back();
  EXPECT_LT((tip.x_m - Eigen::Vector3d(0, 0, 0.12)).norm(), 1e-15);
  EXPECT_LT((tip.frame.col(0) - Eigen::Vector3d::UnitY()).norm(), 1e-15);
}

}  // namespace
}  // namespace bpms
