// What the rows of a mesh's organs say: properties and parameters, the dead part of a leaf, joints; stems of
// varying radius and bent ones against their closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "plant/leaf_frame.h"
#include "plant/plant_mesh.h"
#include "tests/data.h"
#include "tests/plant/plant_text.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

double volume_m3(const Mesh& mesh) {
  double out = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d p = mesh.positions_m[a].cast<double>(), q = mesh.positions_m[b].cast<double>();
    out += p.dot(q.cross(mesh.positions_m[c].cast<double>())) / 6;
  }
  return out;
}

TEST(Properties, AreCarriedToTheMesh) {
  const Plant plant = test::plant_of(
      "organ o { [l][l] l 1 { a_length 1 a_width 1 p_age_d 7 } l 2 { a_length 1 a_width 1 } }\n"
      "[s][l]c s { a_length 3 a_radius 1 p_age_d 12 p_water_status low p_note \"a \\\"b\\\" # c\" }\n"
      "l { a_length 2 a_width 1 } c { organ o p_age_d 3 p_rank (2 * 4) }");
  const Mesh mesh = plant_mesh(plant, {1e-3});
  ASSERT_EQ(mesh.organs.size(), 4u);
  EXPECT_THAT(mesh.organs[0].properties,
              ElementsAre(Pair("age_d", "12"), Pair("water_status", "low"), Pair("note", "a \"b\" # c")));
  EXPECT_THAT(mesh.organs[1].properties, IsEmpty());
  // The parts of a compound organ have their own and what they lack of its.
  EXPECT_THAT(mesh.organs[2].properties, ElementsAre(Pair("age_d", "7"), Pair("rank", "8")));
  EXPECT_THAT(mesh.organs[3].properties, ElementsAre(Pair("age_d", "3"), Pair("rank", "8")));
  EXPECT_THAT(mesh.organs[0].parameters, IsEmpty());
}

TEST(Properties, AreCheckedWhereTheyStand) {
  EXPECT_REFUSED("+ + { p_x 1 }", "x.bpms:1:7: semantic error: a rotation has no p_x");
  EXPECT_REFUSED("l l { p_x 1 p_x 2 }", "x.bpms:1:13: semantic error: a second 'p_x' in one block");
  EXPECT_REFUSED("l l { p_x }", "x.bpms:1:11: syntax error: found '}', expected the value of p_x");
  EXPECT_REFUSED("l l { p_x a_length 3 }",
                 "x.bpms:1:11: syntax error: found 'a_length', expected the value of p_x");
  EXPECT_REFUSED("l l { p_x p_y 3 }", "found 'p_y', expected the value of p_x");
  EXPECT_REFUSED("l l { p_x a+b }",
                 "found 'a+b', expected the value of p_x: letters, digits, _ - . or a text in quotes");
  EXPECT_REFUSED("l l { p_x \"a }", "x.bpms:1:11: syntax error: string opened here is never closed");
  EXPECT_REFUSED("l l { p_ 1 }", "unknown attribute 'p_'");
  EXPECT_REFUSED("l l { p_a-b 1 }", "unknown attribute 'p_a-b'");
}

TEST(Parameters, AreTheAttributesAsThePlantIsWritten) {
  const Plant plant = test::plant_of(
      "units mm l l { material green a_length 100 a_width (2 * 5) a_inclination 20 a_senescent 0.25"
      " f_twist n 0 0 1 90 p_x 1 }");
  const Mesh mesh = plant_mesh(plant, {1e-3, true});
  EXPECT_THAT(mesh.organs[0].parameters,
              ElementsAre(Pair("material", "green"), Pair("a_length", "100 mm"), Pair("a_width", "10 mm"),
                          Pair("a_inclination", "20 deg"), Pair("a_senescent", "0.25"),
                          Pair("f_twist", "n 0 0 1 90")));
}

TEST(Senescence, CutsTheLeafExactly) {
  struct Case {
    const char* attributes;
    double fraction, dead_cm2;
  };
  for (const Case& c : {Case{"f_inclination n 0 0 1 120", 0.3, 3 * 0.3 * 10},
                        {"f_width n 0 1 1 0", 0.3, 3 * 10 * 0.3 * 0.3 / 2},
                        // A knot so near to the cut that both cannot have rows of their own.
                        {"f_width n 0 1 0.70000001 1 1 1", 0.3, 3 * 0.3 * 10},
                        {"f_curvature n 0 60 1 60", 0.999999, 3 * 0.999999 * 10},
                        {"f_inclination p 0 10 20 30", 1e-5, 3 * 1e-5 * 10}}) {
    const Plant plant =
        test::plant_of(fmt::format("[l][s] l {{ a_length 10 a_width 3 a_senescent {} {} }}"
                                   " s {{ a_length 1 a_radius 0.1 }}",
                                   c.fraction, c.attributes));
    const Mesh mesh = plant_mesh(plant);
    ASSERT_EQ(mesh.organs.size(), 3u);
    const Mesh::Organ &green = mesh.organs[0], &dead = mesh.organs[1];
    EXPECT_EQ(green.id, 0);
    EXPECT_EQ(dead.id, 0);
    EXPECT_EQ(mesh.organs[2].id, 1);
    EXPECT_EQ(dead.label, "l1");
    EXPECT_EQ(dead.kind, "leaf");
    EXPECT_EQ(green.material, "leaf");
    EXPECT_EQ(dead.material, "senescent");
    EXPECT_NEAR(dead.length_m, 0.1 * c.fraction, 1e-15);
    EXPECT_NEAR(green.length_m, 0.1 * (1 - c.fraction), 1e-15);
    // As near as the leaf's whole area is to its integral (1e-4); single precision counts in thin parts.
    EXPECT_NEAR(dead.area_m2 * 1e4, c.dead_cm2, 1e-4 * c.dead_cm2 + 1e-5) << c.attributes;
    const float cut = static_cast<float>(1 - c.fraction);
    std::vector<double> areas(mesh.organs.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      areas[mesh.organ_of_triangle[t]] += triangle_area_m2(mesh, t);
      for (const std::uint32_t v : mesh.triangles[t]) {
        if (mesh.organ_of_triangle[t] == 0) {
          EXPECT_LE(mesh.uv[v].x(), cut);
        } else if (mesh.organ_of_triangle[t] == 1) {
          EXPECT_GE(mesh.uv[v].x(), cut);
        }
      }
    }
    EXPECT_NEAR(areas[0], green.area_m2, 1e-12);
    EXPECT_NEAR(areas[1], dead.area_m2, 1e-12);
  }
}

TEST(Senescence, HasItsMaterialAndItsLimits) {
  const Plant plant =
      test::plant_of("l l { a_length 10 a_width 3 a_senescent 1 senescent_material straw p_x 1 }");
  const Mesh mesh = plant_mesh(plant);
  ASSERT_EQ(mesh.organs.size(), 1u);
  EXPECT_EQ(mesh.organs[0].material, "straw");
  EXPECT_EQ(plant_mesh(test::plant_of("l l { a_length 10 a_width 3 a_senescent 0 }")).organs.size(), 1u);
  const Mesh half = plant_mesh(test::plant_of("l l { a_length 10 a_width 3 a_senescent 0.5 p_x 1 }"));
  EXPECT_EQ(half.organs[1].properties, half.organs[0].properties);
  EXPECT_REFUSED("l l { a_senescent 1.5 }",
                 "x.bpms:1:19: semantic error: a_senescent is 1.5, expected a number from 0 to 1");
  EXPECT_REFUSED("l l { a_senescent -0.1 }", "a_senescent is -0.1");
  EXPECT_REFUSED("s s { a_senescent 0.1 }", "a stem has no a_senescent");
  EXPECT_THAT(
      test::plant_of("l l { a_length 10 a_width 3 senescent_material straw }").warnings,
      ElementsAre("x.bpms:1:29: a senescent material, but no a_senescent: nothing of the leaf has it"));
}

TEST(Joint, IsASphereAtTheStemsTip) {
  const double tolerance = 1e-5, radius = 0.005, length = 0.1, joint = 1.5 * 0.8 * radius;
  const std::string stem = "units cm s s { a_length 10 a_radius 0.5 f_width n 0 1 1 0.8";
  const Mesh bare = plant_mesh(test::plant_of(stem + " }"), {tolerance});
  const Mesh mesh = plant_mesh(test::plant_of(stem + " a_joint 1.5 }"), {tolerance});
  ASSERT_EQ(mesh.organs.size(), 1u);
  const double sphere_m2 = 4 * pi * joint * joint;
  EXPECT_NEAR(mesh.organs[0].area_m2 - bare.organs[0].area_m2, sphere_m2, 0.005 * sphere_m2);
  EXPECT_NEAR(volume_m3(mesh) - volume_m3(bare), 4 * pi / 3 * std::pow(joint, 3),
              2 * tolerance / joint * 4 * pi * std::pow(joint, 3));
  double highest = 0, widest = 0;
  for (const Eigen::Vector3f& p : mesh.positions_m) {
    highest = std::max(highest, static_cast<double>(p.z()));
    if (static_cast<double>(p.z()) > length)
      widest = std::max(widest, static_cast<double>(p.head<2>().norm()));
  }
  EXPECT_NEAR(highest, length + joint, tolerance);
  EXPECT_NEAR(widest, joint, joint * 0.05);  // the ring next above the tip
  for (std::size_t v = bare.positions_m.size(); v < mesh.positions_m.size(); ++v)
    EXPECT_EQ(mesh.uv[v].x(), 1);
  // At the tip of a bent stem.
  const Plant bent =
      test::plant_of("units m s s { a_length 1 a_radius 0.01 a_joint 2 f_inclination n 0 0 1 90 }");
  Eigen::Vector3d low = Eigen::Vector3d::Constant(10), high = -low;
  const Mesh bent_mesh = plant_mesh(bent, {tolerance});
  for (std::size_t v = 0; v < bent_mesh.positions_m.size(); ++v) {
    if (bent_mesh.uv[v].x() < 1) continue;
    low = low.cwiseMin(bent_mesh.positions_m[v].cast<double>());
    high = high.cwiseMax(bent_mesh.positions_m[v].cast<double>());
  }
  const double tip = 2 / pi;
  EXPECT_LT(((low + high) / 2 - Eigen::Vector3d(tip, 0, tip)).norm(), 10 * tolerance);
  EXPECT_THAT(test::plant_of("s s { a_length 1 a_radius 0.1 f_width n 0 1 1 0 a_joint 1 }").warnings,
              ElementsAre("x.bpms:1:49: the stem ends in a point, where a joint has no size"));
  EXPECT_REFUSED("l l { a_joint 1 }", "a leaf has no a_joint");
  EXPECT_REFUSED("s s { a_joint -1 }", "a_joint is -1, expected a number from 0 to 100");
}

TEST(Stem, OfVaryingRadiusIsAFrustum) {
  const double tolerance = 1e-5, length = 0.12, r = 0.01, q = 0.004;
  const Mesh mesh =
      plant_mesh(test::plant_of("units cm s s { a_length 12 a_radius 1 f_width n 0 1 1 0.4 }"), {tolerance});
  const double area = pi * (r + q) * std::hypot(length, r - q) + pi * (r * r + q * q);
  const double volume = pi * length / 3 * (r * r + r * q + q * q);
  // The polygon's circumference is the circle's; its area is larger by twice the part that the tolerance
  // leaves.
  EXPECT_NEAR(mesh.organs[0].area_m2, area, 2 * tolerance / r * area);
  EXPECT_NEAR(volume_m3(mesh), volume, 2 * tolerance / r * volume);
}

TEST(Stem, BentIntoAnArcIsAPieceOfATorus) {
  const double tolerance = 1e-5, length = 0.2, r = 0.01;
  const Plant plant = test::plant_of("units cm s s { a_length 20 a_radius 1 f_inclination n 0 0 1 90 }");
  const Mesh mesh = plant_mesh(plant, {tolerance});
  // Pappus: what the section's circle and disc sweep along their centre's path.
  EXPECT_NEAR(mesh.organs[0].area_m2, 2 * pi * r * length + 2 * pi * r * r,
              2 * tolerance / r * 2 * pi * r * length);
  EXPECT_NEAR(volume_m3(mesh), pi * r * r * length, 2 * tolerance / r * pi * r * r * length);
  const MidribPoint tip = midrib(plant.blocks[0].attributes, {1.0}).back();
  const double radius = length / (pi / 2);
  EXPECT_LT((tip.x_m - Eigen::Vector3d(radius, 0, radius)).norm(), 1e-10);
  EXPECT_LT((tip.frame.col(2) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
}

}  // namespace
}  // namespace bpms
