// The turtle: where organs stand and which way they face.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "plant/leaf_frame.h"

namespace bpms {
namespace {

using Eigen::Vector3d;

Plant parse(const std::string& text) {
  return parse_plant("x.bpms", text);
}
Vector3d base_m(const PlacedOrgan& organ) {
  return organ.plant_from_organ.translation();
}
Vector3d axis(const PlacedOrgan& organ, int k) {
  return organ.plant_from_organ.linear().col(k);
}

TEST(PlaceOrgans, GrassHasItsTopology) {
  const Plant plant = read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms");
  const std::vector<PlacedOrgan> organs = place_organs(plant);
  ASSERT_EQ(organs.size(), 6u);
  std::vector<std::string> labels;
  for (const PlacedOrgan& organ : organs) labels.push_back(organ.label);
  EXPECT_THAT(labels, testing::ElementsAre("s1", "l1", "l2", "s2", "l3", "h1"));
  for (int i = 0; i < 6; ++i) EXPECT_EQ(organs[static_cast<std::size_t>(i)].id, i);
  // Both lower leaves start at the first stem's tip, the upper leaf and the head at the second's.
  EXPECT_LT((base_m(organs[0]) - Vector3d(0, 0, 0)).norm(), 1e-15);
  for (const int i : {1, 2, 3})
    EXPECT_LT((base_m(organs[static_cast<std::size_t>(i)]) - Vector3d(0, 0, 0.12)).norm(), 1e-15);
  for (const int i : {4, 5})
    EXPECT_LT((base_m(organs[static_cast<std::size_t>(i)]) - Vector3d(0, 0, 0.20)).norm(), 1e-15);
  // The first two leaves lean to opposite sides.
  const auto tip = [&](std::size_t i) {
    const Vector3d end = midrib(*organs[i].attributes, {1}).back().x_m;
    return Vector3d(organs[i].plant_from_organ * end);
  };
  EXPECT_GT(tip(1).x(), 0.05);
  EXPECT_NEAR(tip(1).y(), 0, 1e-12);
  EXPECT_NEAR(tip(2).x(), -tip(1).x(), 1e-12);
  // The head's axis goes on from the stem's: the bracket of the leaf has restored the frame.
  EXPECT_LT((axis(organs[5], 2) - Vector3d::UnitZ()).norm(), 1e-15);
}

TEST(PlaceOrgans, PositiveInclinationLeansOutwardAndTwistTurnsCounterclockwise) {
  // A leaf that lies along its inclination of 90 degrees, turned by a quarter about the stem: from east to
  // north.
  const auto tip = [](const std::string& twist) {
    const Plant plant =
        parse("[+l]\n+ { a_twist " + twist + " }\nl { a_length 100 a_width 1 a_inclination 90 }");
    const PlacedOrgan organ = place_organs(plant)[0];
    return Vector3d(organ.plant_from_organ * midrib(*organ.attributes, {1}).back().x_m);
  };
  EXPECT_LT((tip("0") - Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((tip("90") - Vector3d(0, 1, 0)).norm(), 1e-12);
  EXPECT_LT((tip("-90") - Vector3d(0, -1, 0)).norm(), 1e-12);
}

TEST(PlaceOrgans, AnAsymmetricPlantKeepsItsHand) {
  // Stem up, then three unlike branches: each must be where a right-handed walk by hand puts it.
  const Plant plant = parse(
      "units m s[+(1)s(2)s(2)][+(2)s(2)]\n s { a_length 1 a_radius 0.01 } s 2 { a_length 0.5 a_radius 0.01 "
      "}\n"
      "+ 1 { a_inclination 30 a_azimuth 20 a_twist 50 } + 2 { a_azimuth -90 }");
  const std::vector<PlacedOrgan> organs = place_organs(plant);
  ASSERT_EQ(organs.size(), 4u);
  const double i = radians(30), a = radians(20);
  const Vector3d direction(std::cos(a) * std::sin(i), -std::sin(a), std::cos(a) * std::cos(i));
  EXPECT_LT((axis(organs[1], 2) - direction).norm(), 1e-12);
  EXPECT_LT((base_m(organs[2]) - (Vector3d(0, 0, 1) + 0.5 * direction)).norm(), 1e-12);
  EXPECT_LT((axis(organs[3], 2) - Vector3d(0, 1, 0)).norm(), 1e-12);  // -90 about x: up goes to north
  for (const PlacedOrgan& organ : organs)
    EXPECT_NEAR(organ.plant_from_organ.linear().determinant(), 1, 1e-12);
}

TEST(PlaceOrgans, StemsHandOnTheirTipFrame) {
  // A stem that bends over a quarter circle of radius 2 L / pi and twists by a quarter on the way.
  const Plant plant = parse(
      "units m sl\ns { a_length 1 a_radius 0.01 f_inclination n 0 0 1 90 f_twist n 0 0 1 90 }\nl { a_length "
      "1 a_width 0.1 }");
  const PlacedOrgan organ = place_organs(plant)[1];
  EXPECT_LT((base_m(organ) - Vector3d(2 / pi, 0, 2 / pi)).norm(), 1e-9);
  EXPECT_LT((axis(organ, 2) - Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((axis(organ, 0) - Vector3d::UnitY()).norm(), 1e-12);  // Ry(90) Rz(90): x goes to y
}

TEST(PlaceOrgans, BudsAreOneDiameterHighAndOrgansWithoutABlockHaveNoExtent) {
  const Plant plant = parse("units m bsl\nb { a_radius 0.1 a_inclination 90 }\nl { a_length 1 a_width 0.1 }");
  const std::vector<PlacedOrgan> organs = place_organs(plant);
  EXPECT_LT((base_m(organs[1]) - Vector3d(0.2, 0, 0)).norm(), 1e-12);
  EXPECT_LT((base_m(organs[2]) - Vector3d(0.2, 0, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace bpms
