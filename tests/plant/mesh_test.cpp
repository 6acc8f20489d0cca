// Triangles against the surfaces they stand for: areas, closeness, closedness, normals.
#include "plant/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "core/units.h"
#include "plant/geometry/leaf_surface.h"
#include "plant/geometry/mesh_parts.h"
#include "plant/geometry/subdivide.h"
#include "plant/plant_mesh.h"
#include "tests/data.h"

namespace bpms {
namespace {

Plant one_leaf(const std::string& functions) {
  return parse_plant("leaf.bpms",
                     "units cm\nl\nl 1 { material leaf a_length 10 a_width 3 " + functions + " }\n");
}
double area_cm2(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) sum += triangle_area_m2(mesh, i);
  return sum * 1e4;
}
Eigen::Vector3f triangle_normal(const Mesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.positions_m[b] - mesh.positions_m[a]).cross(mesh.positions_m[c] - mesh.positions_m[a]);
}

TEST(LeafArea, IsLengthTimesWidthWithoutTwistAndCurvature) {
  for (const char* functions :
       {"", "f_inclination n 0 0 1 45", "f_inclination n 0 0 1 180", "f_inclination n 0 90 1 90"}) {
    const Plant plant = one_leaf(functions);
    EXPECT_NEAR(leaf_surface_area_m2(plant.blocks[0].attributes) * 1e4, 30, 1e-9);
    const Mesh mesh = plant_mesh(plant);
    EXPECT_NEAR(mesh.organs[0].area_m2 * 1e4, 30, 30 * 1e-4) << functions;
    EXPECT_NEAR(area_cm2(mesh), mesh.organs[0].area_m2 * 1e4, 1e-9);
  }
}

TEST(LeafArea, GrowsWithTwistAsTheIntegralSays) {
  struct Case {
    double twist_deg, printed;
  };
  for (const Case& c : {Case{90, 30.275}, {360, 33.98}}) {
    const Plant plant = one_leaf(fmt::format("f_twist n 0 0 1 {}", c.twist_deg));
    // Helicoid of half-width h and rate w: integral of sqrt(1 + w^2 v^2) in closed form.
    const double w = radians(c.twist_deg) / 10;
    const double h = 1.5;
    const double exact = 10 * (h * std::sqrt(1 + w * w * h * h) + std::asinh(w * h) / w);
    EXPECT_NEAR(exact, c.printed, c.twist_deg == 90 ? 6e-4 : 6e-3);
    EXPECT_NEAR(leaf_surface_area_m2(plant.blocks[0].attributes) * 1e4, exact, 1e-8 * exact);
    EXPECT_NEAR(area_cm2(plant_mesh(plant)), exact, 1e-4 * exact);
  }
}

TEST(LeafArea, AgreesWithTheIntegralForEveryShape) {
  for (const char* functions :
       {"f_inclination n 0 0 1 180 f_curvature n 0 30 1 30",
        "f_inclination p 15 40 30 f_width n 0 0.6 0.3 1 1 0 f_twist f 10 -10", "f_width p 0 4 -4",
        "f_curvature n 0 180 1 0 f_twist n 0 0 1 120",
        "f_inclination s 0 5 0.5 60 1 150 f_azimuth n 0 0 1 60 f_curvature n 0 -40 1 90",
        "f_width n 0 0 0.5 1 0.7 0 1 1"}) {
    const Plant plant = one_leaf(functions);
    const double integral = leaf_surface_area_m2(plant.blocks[0].attributes) * 1e4;
    const Mesh mesh = plant_mesh(plant);
    EXPECT_NEAR(area_cm2(mesh), integral, 1e-4 * integral) << functions;
    EXPECT_LT(mesh.triangles.size(), 20000u) << functions;
    // Ten times coarser: the width still makes up for the area, with fewer triangles.
    const Mesh coarse = plant_mesh(plant, {1e-3});
    EXPECT_NEAR(area_cm2(coarse), integral, 1e-4 * integral) << functions;
    EXPECT_LE(coarse.triangles.size(), mesh.triangles.size());
  }
}

const char* const shapes[] = {
    "f_inclination n 0 0 1 180",
    "f_inclination n 0 0 1 180 f_curvature n 0 30 1 30",
    "f_inclination p 15 40 30 f_width n 0 0.6 0.3 1 1 0 f_twist f 10 -10 f_curvature n 0 20 1 5",
    "f_twist n 0 0 1 360",
    "f_inclination s 0 5 0.5 60 1 150 f_azimuth n 0 0 1 60 f_curvature n 0 -40 1 90",
};

TEST(LeafMesh, StaysWithinTheToleranceOfTheSurface) {
  for (const double tolerance_m : {1e-4, 1e-3}) {
    for (const char* functions : shapes) {
      const Plant plant = one_leaf(functions);
      const OrganAttributes& leaf = plant.blocks[0].attributes;
      const Mesh mesh = plant_mesh(plant, {tolerance_m});
      double worst = 0;
      for (const auto& [a, b, c] : mesh.triangles) {
        for (const Eigen::Vector3f& w :
             {Eigen::Vector3f(1, 1, 1), {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {4, 1, 1}}) {
          const Eigen::Vector3f weight = w / w.sum();
          const Eigen::Vector2f uv = weight[0] * mesh.uv[a] + weight[1] * mesh.uv[b] + weight[2] * mesh.uv[c];
          const Eigen::Vector3f point = weight[0] * mesh.positions_m[a] + weight[1] * mesh.positions_m[b] +
                                        weight[2] * mesh.positions_m[c];
          const LeafRow row = leaf_rows(leaf, {static_cast<double>(uv.x())}).front();
          const double s = 2 * static_cast<double>(uv.y()) - 1;
          const Eigen::Vector3d offset = point.cast<double>() - leaf_point_m(row, s);
          worst = std::max(worst, std::abs(offset.dot(leaf_normal(row, s))));
        }
      }
      EXPECT_LT(worst, tolerance_m) << functions;
      EXPECT_GT(worst, 0.01 * tolerance_m) << functions;  // and not much finer than was asked for
    }
  }
}

TEST(LeafMesh, NormalsAreUnitAndOnTheUpperSide) {
  for (const char* functions : shapes) {
    const Mesh mesh = plant_mesh(one_leaf(functions));
    for (const Eigen::Vector3f& normal : mesh.normals) EXPECT_NEAR(normal.norm(), 1, 1e-5);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t])
        EXPECT_GT(triangle_normal(mesh, t).dot(mesh.normals[v]), 0);
    }
  }
  // A leaf that lies along x: its upper face looks up; x is its downward-facing side.
  const Mesh flat = plant_mesh(one_leaf("f_inclination n 0 90 1 90"));
  for (const Eigen::Vector3f& normal : flat.normals) EXPECT_NEAR(normal.z(), 1, 1e-6);
}

TEST(LeafMesh, EdgesAreSharedByTwoTrianglesAndTheOutlineByOne) {
  for (const char* functions : shapes) {
    const Mesh mesh = plant_mesh(one_leaf(functions));
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& [a, b, c] : mesh.triangles) {
      for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) ++edges[{from, to}];
    }
    // Every directed edge occurs once: all triangles face one way, and no edge has three.
    std::size_t outline = 0;
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      if (!edges.contains({edge.second, edge.first})) ++outline;
    }
    // One boundary and no hole: V - E + F = 1.
    const std::size_t edge_count = (edges.size() + outline) / 2;
    EXPECT_EQ(mesh.positions_m.size() + mesh.triangles.size(), edge_count + 1) << functions;
  }
}

TEST(LeafMesh, EndsInOnePointWhereTheWidthVanishes) {
  const Mesh mesh = plant_mesh(one_leaf("f_width p 0 4 -4"));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) EXPECT_GT(triangle_area_m2(mesh, t), 1e-12);
  int at_tip = 0;
  for (const Eigen::Vector2f& uv : mesh.uv) at_tip += uv.x() == 1 ? 1 : 0;
  EXPECT_EQ(at_tip, 1);
}

TEST(LeafSection, IsAnArcOfTheStatedHalfAngle) {
  struct Case {
    double half_angle_deg, radius, chord, sagitta;
  };
  for (const Case& c : {Case{30, 2.8648, 2.8648, 0.3838}, {90, 0.9549, 1.9099, 0.9549}}) {
    const Plant plant = one_leaf(fmt::format("f_curvature n 0 {0} 1 {0}", c.half_angle_deg));
    const LeafRow row = leaf_rows(plant.blocks[0].attributes, {0.5}).front();
    const Eigen::Vector3d left = 100 * leaf_section_m(row, -1);
    const Eigen::Vector3d right = 100 * leaf_section_m(row, 1);
    EXPECT_LT(leaf_section_m(row, 0).norm(), 1e-15);  // the midrib stays where it is
    EXPECT_NEAR((right - left).norm(), c.chord, 5.1e-5);
    EXPECT_NEAR(-right.x(), c.sagitta, 5.1e-5);  // towards -x: the upper side
    EXPECT_NEAR(-left.x(), c.sagitta, 5.1e-5);
    EXPECT_GT(right.y(), left.y());
    const Eigen::Vector3d centre(-c.radius, 0, 0);
    double arc = 0;
    Eigen::Vector3d before = left;
    for (int i = 0; i <= 1000; ++i) {
      const Eigen::Vector3d point = 100 * leaf_section_m(row, -1 + 0.002 * i);
      EXPECT_NEAR((point - centre).norm(), c.radius, 1e-4);
      arc += (point - before).norm();
      before = point;
    }
    EXPECT_NEAR(arc, 3, 1e-5);
  }
}

// A closed body: welded by position, every directed edge once and its opposite once; volume positive
// (outward).
void expect_closed(const Mesh& mesh, double volume_m3, double relative) {
  std::map<std::array<float, 3>, int> weld;
  std::vector<int> id;
  for (const Eigen::Vector3f& p : mesh.positions_m)
    id.push_back(weld.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(weld.size())).first->second);
  std::map<std::pair<int, int>, int> edges;
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) ++edges[{id[from], id[to]}];
    volume +=
        static_cast<double>(mesh.positions_m[a].dot(mesh.positions_m[b].cross(mesh.positions_m[c]))) / 6;
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
  EXPECT_NEAR(volume, volume_m3, relative * volume_m3);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t])
      EXPECT_GT(triangle_normal(mesh, t).normalized().dot(mesh.normals[v]), 0);
  }
  for (const Eigen::Vector3f& normal : mesh.normals) EXPECT_NEAR(normal.norm(), 1, 1e-5);
}

TEST(SweptMesh, StemsHeadsAndBudsAreClosed) {
  const Mesh stem = plant_mesh(parse_plant("s.bpms", "units cm s s { a_length 12 a_radius 0.2 }"));
  expect_closed(stem, pi * 4e-6 * 0.12, 0.02);
  EXPECT_NEAR(stem.organs[0].area_m2, 2 * pi * 0.002 * 0.12 + 2 * pi * 4e-6, 1e-3 * stem.organs[0].area_m2);
  const Mesh bent = plant_mesh(parse_plant(
      "s.bpms", "units cm s s { a_length 12 a_radius 0.2 f_inclination n 0 0 1 90 f_width n 0 1 1 0.5 }"));
  expect_closed(bent, pi * 4e-6 * 0.12 * (1 + 0.5 + 0.25) / 3, 0.03);
  const Mesh bud = plant_mesh(parse_plant("b.bpms", "units cm b b { a_radius 1 }"));
  expect_closed(bud, 4 * pi / 3 * 1e-6, 0.02);
  EXPECT_NEAR(bud.organs[0].area_m2, 4 * pi * 1e-4, 0.005 * bud.organs[0].area_m2);
  Eigen::Vector3f low = bud.positions_m[0], high = low;
  for (const Eigen::Vector3f& p : bud.positions_m) low = low.cwiseMin(p), high = high.cwiseMax(p);
  EXPECT_NEAR(low.z(), 0, 1e-7);  // it sits on its base
  EXPECT_NEAR(high.z(), 0.02, 1e-7);
  const Mesh head = plant_mesh(parse_plant("h.bpms", "units cm h h { a_length 6 a_radius 0.4 }"));
  expect_closed(head, 4 * pi / 3 * 0.03 * 0.004 * 0.004, 0.03);
  const Mesh cone =
      plant_mesh(parse_plant("h.bpms", "units cm h h { a_length 6 a_radius 0.4 f_width n 0 1 1 0 }"));
  expect_closed(cone, pi / 3 * 0.06 * 0.004 * 0.004, 0.02);
}

TEST(PlantMesh, KeepsOrganMaterialAndUv) {
  const Plant plant = read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms");
  EXPECT_TRUE(plant.warnings.empty());
  const Mesh mesh = plant_mesh(plant);
  std::vector<std::string> labels;
  for (const Mesh::Organ& organ : mesh.organs) labels.push_back(organ.label + ":" + organ.material);
  EXPECT_THAT(labels, testing::ElementsAre("s1:stem", "l1:leaf", "l2:leaf", "s2:stem", "l3:leaf", "h1:head"));
  ASSERT_EQ(mesh.organ_of_triangle.size(), mesh.triangles.size());
  std::vector<double> areas(mesh.organs.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    areas[mesh.organ_of_triangle[t]] += triangle_area_m2(mesh, t);
  for (std::size_t i = 0; i < areas.size(); ++i) EXPECT_NEAR(areas[i], mesh.organs[i].area_m2, 1e-9);
  for (const Eigen::Vector2f& uv : mesh.uv) EXPECT_TRUE((uv.array() >= 0).all() && (uv.array() <= 1).all());
  EXPECT_DOUBLE_EQ(mesh.organs[3].length_m, 0.08);
}

TEST(CircleSides, StayWithinTheToleranceAndTheirBounds) {
  for (const double radius : {1e-3, 0.1, 7.0}) {
    const int sides = circle_sides(radius, 1e-4, 3, 100000);
    EXPECT_LE(radius * (1 - std::cos(pi / sides)), 1e-4 * (1 + 1e-9));
    EXPECT_GT(radius * (1 - std::cos(pi / (sides - 1))), 1e-4);  // one less would not do
  }
  EXPECT_EQ(circle_sides(1e-6, 1e-4, 6, 64), 6);
  EXPECT_EQ(circle_sides(8.9e21, 1e-4, 6, 64), 64);
}

}  // namespace
}  // namespace bpms
