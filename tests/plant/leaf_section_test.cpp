// Cross-sections of leaves against closed forms, their meshes, and how the language says them.
#include "plant/geometry/sections/section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/units.h"
#include "plant/geometry/leaf_surface.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

Plant leaf_with(const std::string& attributes) {
  return parse_plant("leaf.bpms", "units cm\nl\nl { a_length 10 a_width 3 " + attributes + " }\n");
}
const OrganAttributes& leaf_of(const Plant& plant) {
  return plant.blocks[0].attributes;
}
LeafRow middle_row(const Plant& plant) {
  return leaf_rows(leaf_of(plant), {0.5}).front();
}

constexpr const char* keel = "section raised_midrib a_midrib_width 0.12 a_midrib_height 0.08 ";

TEST(VFold, HasTheChordAndDepthOfItsAngle) {
  for (const double deg : {0.0, 20.0, 45.0, 90.0, -30.0}) {
    const Plant plant = leaf_with(fmt::format("section v_fold f_curvature n 0 {0} 1 {0}", deg));
    const LeafRow row = middle_row(plant);
    const Eigen::Vector3d left = leaf_section_m(row, -1), right = leaf_section_m(row, 1);
    EXPECT_NEAR((right - left).norm(), 0.03 * std::cos(radians(deg)), 1e-15);
    EXPECT_NEAR(-left.x(), 0.015 * std::sin(radians(deg)), 1e-15);  // towards -x: the upper side
    EXPECT_NEAR(-right.x(), 0.015 * std::sin(radians(deg)), 1e-15);
    EXPECT_LT(leaf_section_m(row, 0).norm(), 1e-15);
    EXPECT_NEAR((leaf_section_m(row, 0.5) - right / 2).norm(), 0, 1e-15);  // straight halves
  }
}

TEST(VFold, AreaOfAConstantWidthIsLengthTimesWidth) {
  for (const char* functions :
       {"f_curvature n 0 40 1 40", "f_curvature n 0 40 1 40 f_inclination n 0 0 1 0"}) {
    const Plant plant = leaf_with(std::string("section v_fold ") + functions);
    EXPECT_NEAR(leaf_surface_area_m2(leaf_of(plant)) * 1e4, 30, 1e-9);
    EXPECT_NEAR(plant_mesh(plant).organs[0].area_m2 * 1e4, 30, 30 * 1e-6);  // single precision
  }
}

// A V that arches in its plane of symmetry at the rate k: every ruling moves along by L - k x, with x from 0
// to
// -(w/2) sin c: the area is L w (1 + (k / L) (w / 4) sin c).
TEST(VFold, AreaOfAnArchIsThatOfItsRulings) {
  const double k = radians(60), c = radians(35), length = 0.1, width = 0.03;
  const Plant plant = leaf_with("section v_fold f_curvature n 0 35 1 35 f_inclination n 0 0 1 60");
  const double exact = length * width * (1 + k / length * width / 4 * std::sin(c));
  EXPECT_NEAR(leaf_surface_area_m2(leaf_of(plant)), exact, 1e-10 * exact);
  EXPECT_NEAR(plant_mesh(plant).organs[0].area_m2, exact, 1e-4 * exact);
}

TEST(RaisedMidrib, HasTheStatedKeelAndAFlatBlade) {
  const Plant plant = leaf_with(keel);
  const LeafRow row = middle_row(plant);
  const double slope = std::hypot(0.06, 0.08);      // 0.1 of the width
  EXPECT_LT(leaf_section_m(row, 0).norm(), 1e-15);  // the ridge is the midrib
  const Eigen::Vector3d foot = leaf_section_m(row, 2 * slope), edge = leaf_section_m(row, 1);
  EXPECT_NEAR(foot.y(), 0.03 * 0.06, 1e-15);
  EXPECT_NEAR(foot.x(), -0.03 * 0.08, 1e-15);  // the blade lies towards the upper side
  EXPECT_NEAR(edge.x(), foot.x(), 1e-15);
  EXPECT_NEAR(edge.y() - foot.y(), 0.03 * (0.5 - slope), 1e-15);
  EXPECT_NEAR(leaf_surface_area_m2(leaf_of(plant)) * 1e4, 30, 1e-9);
}

TEST(LeafSections, AreAsLongAsTheLeafIsWideAndEveryPanelIsUnitSpeed) {
  for (const char* section : {"f_curvature n 0 70 1 70", "section v_fold f_curvature n 0 70 1 70", keel}) {
    const LeafRow row = middle_row(leaf_with(section));
    double length = 0;
    Eigen::Vector3d before = leaf_section_m(row, -1);
    constexpr int steps = 4000;
    for (int i = 1; i <= steps; ++i) {
      const double s = -1 + 2.0 * i / steps;
      const Eigen::Vector3d at = leaf_section_m(row, s);
      EXPECT_NEAR((at - before).norm(), 0.03 / steps,
                  2e-7 * 0.03);  // arcs against chords, folds inside a step
      length += (at - before).norm();
      before = at;
    }
    EXPECT_NEAR(length, 0.03, 1e-5 * 0.03);
  }
}

// What the sections give for the derivatives by the half-angle, against differences.
TEST(LeafSections, KnowTheirDerivativeByTheHalfAngle) {
  constexpr double step = 1e-6;
  for (const char* name : {"arc", "v_fold"}) {
    const LeafSection& section = leaf_section(name);
    for (const double c : {0.0, 1e-5, 0.3, -1.2, 2.9}) {
      for (const double s : {-1.0, -0.4, 0.3, 1.0}) {
        const int panel = section.folds({}).empty() || s < 0 ? 0 : 1;
        const Eigen::Vector2d more = section.point({c + step}, panel, s).at;
        const Eigen::Vector2d less = section.point({c - step}, panel, s).at;
        EXPECT_LT(((more - less) / (2 * step) - section.point({c}, panel, s).by_half_angle).norm(), 1e-9);
      }
    }
  }
}

TEST(LeafSections, MeshesAgreeWithTheIntegralForEveryShape) {
  for (const std::string section : {"", "section v_fold ", keel}) {
    for (const std::string shape :
         {"f_inclination s 0 5 0.5 60 1 150 f_azimuth n 0 0 1 60", "f_twist n 0 0 1 120 f_width p 0 4 -4",
          "f_inclination p 15 40 30 f_width n 0 0.6 0.3 1 1 0 f_twist f 10 -10",
          "f_width n 0 1 0.4 0.5 0.7 -0.5 1 1 f_inclination n 0 0 1 40"}) {
      const bool curved = section != keel;
      const Plant plant = leaf_with(section + shape + (curved ? " f_curvature n 0 -40 1 70" : ""));
      const double integral = leaf_surface_area_m2(leaf_of(plant));
      for (const double tolerance_m : {1e-4, 1e-3})
        EXPECT_NEAR(plant_mesh(plant, {tolerance_m}).organs[0].area_m2, integral, 1e-4 * integral)
            << section << shape;
    }
  }
}

// Every fold is a line of vertices, two at each place, whose normals are those of the panels on either side.
TEST(LeafSections, FoldsAreColumnsWithNormalsOfTheirOwn) {
  const double c = radians(40);
  const Mesh mesh = plant_mesh(leaf_with("section v_fold f_curvature n 0 40 1 40"));
  int on_fold = 0;
  for (std::size_t k = 0; k < mesh.uv.size(); ++k) {
    const Eigen::Vector3f& n = mesh.normals[k];
    EXPECT_NEAR(std::abs(n.y()), std::sin(c), 1e-6);
    EXPECT_NEAR(-n.x(), std::cos(c), 1e-6);
    if (mesh.uv[k].y() != 0.5f) {
      EXPECT_EQ(n.y() > 0, mesh.uv[k].y() < 0.5f);
      continue;
    }
    ++on_fold;
    EXPECT_LT(std::hypot(mesh.positions_m[k].x(), mesh.positions_m[k].y()), 1e-9f);
  }
  EXPECT_GE(on_fold, 4);
  EXPECT_EQ(on_fold % 2, 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const Eigen::Vector3f n = (mesh.positions_m[v[1]] - mesh.positions_m[v[0]])
                                  .cross(mesh.positions_m[v[2]] - mesh.positions_m[v[0]])
                                  .normalized();
    for (const std::uint32_t k : v) EXPECT_GT(n.dot(mesh.normals[k]), 0.9999f);  // facets are flat
  }
}

TEST(LeafSections, AreReadAndWritten) {
  for (const std::string text : {"section v_fold", "section arc",
                                 "section raised_midrib\n  a_midrib_width 0.1\n  a_midrib_height 0.05"}) {
    const Plant plant = leaf_with(text);
    const std::string written = plant_text(plant);
    const Plant again = parse_plant("again.bpms", written);
    EXPECT_EQ(leaf_of(again).section, leaf_of(plant).section);
    EXPECT_EQ(leaf_of(again).midrib_width, leaf_of(plant).midrib_width);
    EXPECT_EQ(leaf_of(again).midrib_height, leaf_of(plant).midrib_height);
    EXPECT_EQ(plant_text(again), written);
    EXPECT_THAT(written, testing::HasSubstr("section " + leaf_of(plant).section));
  }
}

std::string refusal(const std::string& attributes) {
  try {
    leaf_with(attributes);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LeafSections, AreRefusedWhereTheySayWhatCannotBe) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal("section vfold"), HasSubstr("did you mean 'v_fold'?"));
  EXPECT_THAT(refusal("section vfold"), HasSubstr("leaf.bpms:3:"));
  EXPECT_THAT(refusal("section raised_midrib a_midrib_width 0.1"), HasSubstr("needs a_midrib_width and"));
  EXPECT_THAT(refusal("section v_fold a_midrib_width 0.1"), HasSubstr("v_fold has no a_midrib_width"));
  EXPECT_THAT(refusal("a_midrib_height 0.1"), HasSubstr("arc has no a_midrib_height"));
  EXPECT_THAT(refusal(std::string(keel) + "f_curvature n 0 1 1 2"), HasSubstr("has no f_curvature"));
  EXPECT_THAT(refusal("section raised_midrib a_midrib_width 0.9 a_midrib_height 0.4"),
              HasSubstr("slopes are 1.204 of the width"));
}

}  // namespace
}  // namespace bpms
