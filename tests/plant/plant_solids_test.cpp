// Chains of solids against the swept bodies they stand for.
#include "plant/plant_solids.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/random.h"
#include "core/units.h"
#include "plant/geometry/swept_body.h"

namespace bpms {
namespace {

Plant plant_of(const std::string& text) {
  return parse_plant("p.bpms", "units cm " + text);
}

bool in_solid(const PlantSolid& solid, const Eigen::Vector3d& p) {
  const Eigen::Vector3d axis = solid.to_m - solid.from_m;
  const double length = axis.norm(), along = (p - solid.from_m).dot(axis) / length;
  const double across = (p - solid.from_m - along / length * axis).norm();
  const double t = along / length;
  if (solid.kind == PlantSolid::Kind::frustum)
    return t > 0 && t < 1 && across < (1 - t) * solid.first_radius_m + t * solid.second_radius_m;
  return std::pow(2 * t - 1, 2) + std::pow(across / solid.first_radius_m, 2) < 1;
}
bool in_any(const std::vector<PlantSolid>& solids, const Eigen::Vector3d& p) {
  for (const PlantSolid& solid : solids)
    if (in_solid(solid, p)) return true;
  return false;
}

TEST(PlantSolids, AreOneEachWhereTheOrganIsStraight) {
  const std::vector<PlantSolid> solids = plant_solids(
      plant_of("bs+sh b { a_radius 1 } s 1 { a_length 10 a_radius 0.3 f_twist s 0 0 0.3 20 1 90 }\n"
               "s 2 { a_length 5 a_radius 0.2 f_width n 0 1 1 0.5 } + { a_inclination 30 }\n"
               "h { a_length 6 a_radius 0.4 }"));
  ASSERT_EQ(solids.size(), 4u);
  EXPECT_EQ(solids[0].kind, PlantSolid::Kind::spheroid);
  EXPECT_NEAR((solids[0].to_m - Eigen::Vector3d(0, 0, 0.02)).norm(), 0, 1e-12);
  EXPECT_EQ(solids[1].kind, PlantSolid::Kind::frustum);
  EXPECT_NEAR((solids[1].from_m - solids[0].to_m).norm(), 0, 1e-12);
  EXPECT_NEAR((solids[1].to_m - solids[1].from_m).norm(), 0.1, 1e-12);
  EXPECT_DOUBLE_EQ(solids[1].second_radius_m, 0.003);
  EXPECT_DOUBLE_EQ(solids[2].second_radius_m, 0.001);
  EXPECT_EQ(solids[3].kind, PlantSolid::Kind::spheroid);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(solids[static_cast<std::size_t>(k)].organ_id, k);
}

// A hair inside of the body's surface is in a solid, a hair outside is in none, at the bends, too.
TEST(PlantSolids, FillTheBodyWithinTheTolerance) {
  Philox random(1, 2);
  for (const char* text : {"s s { a_length 30 a_radius 1 f_inclination n 0 0 1 90 }",
                           "s s { a_length 10 a_radius 0.5 f_inclination f 20 -30 10 f_azimuth p 0 40 -20 "
                           "f_width s 0 1 0.5 0.6 1 0.8 }",
                           "h h { a_length 8 a_radius 0.6 f_inclination p 0 30 60 }",
                           "h h { a_length 8 a_radius 0.6 f_inclination p 0 70 f_width n 0 0 0.3 1 1 0 }"}) {
    for (const double tolerance : {1e-4, 5e-4}) {
      const Plant plant = plant_of(text);
      const std::vector<PlantSolid> solids = plant_solids(plant, tolerance);
      EXPECT_GT(solids.size(), 3u);
      const PlacedOrgan organ = place_organs(plant)[0];
      const SweptBody body = swept_body(organ.kind, *organ.attributes);
      for (int k = 0; k < 4000; ++k) {
        const Ring ring = rings(body, {random.uniform(0.03, 0.97)}).front();
        const double angle = random.uniform(0, 2 * pi);
        const Eigen::Vector3d radial = ring.frame * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
        if (ring.radius_m > tolerance) {
          EXPECT_TRUE(in_any(solids, ring.centre_m + (ring.radius_m - tolerance) * radial)) << text;
        }
        EXPECT_FALSE(in_any(solids, ring.centre_m + (ring.radius_m + tolerance) * radial)) << text;
      }
    }
  }
}

TEST(PlantSolids, GiveAJointItsBall) {
  const std::vector<PlantSolid> solids = plant_solids(plant_of("s s { a_length 10 a_radius 0.5 a_joint 2 }"));
  ASSERT_EQ(solids.size(), 2u);
  EXPECT_TRUE(in_any(solids, {0.0099, 0, 0.1}));
  EXPECT_TRUE(in_any(solids, {0, 0, 0.1099}));
  EXPECT_FALSE(in_any(solids, {0.0099, 0, 0.05}));
}

}  // namespace
}  // namespace bpms
