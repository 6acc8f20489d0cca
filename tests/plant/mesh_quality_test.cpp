// What is wrong with a mesh, and that nothing is found where nothing is wrong.
#include "plant/mesh_quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.h"
#include "plant/mesh_levels.h"
#include "plant/plant_mesh.h"
#include "plant/structure/orientation.h"

namespace bpms {
namespace {

Mesh leaf_mesh_of(const std::string& attributes, double tolerance_m = 1e-4) {
  return plant_mesh(parse_plant("leaf.bpms", "units cm\nl\nl { a_length 10 a_width 3 " + attributes + " }\n"),
                    {tolerance_m});
}

TEST(MeshQuality, FindsNothingInSoundLeaves) {
  for (const char* shape :
       {"", "f_inclination n 0 0 1 150 f_curvature n 0 30 1 30", "f_curvature n 0 170 1 170",
        "f_curvature n 0 180 1 180",  // closed: its edges touch
        "section v_fold f_curvature n 0 85 1 85 f_twist n 0 0 1 200", "f_twist n 0 0 1 720"}) {
    const MeshQuality quality = mesh_quality(leaf_mesh_of(shape));
    EXPECT_TRUE(quality.crossings.empty()) << shape;
    EXPECT_EQ(quality.degenerate + quality.duplicate_faces + quality.non_manifold_edges, 0u) << shape;
    EXPECT_GT(quality.triangles, 1u);
  }
}

TEST(MeshQuality, SaysWhereALeafCrossesItself) {
  // Rolled past 180 degrees from the middle on only.
  const Mesh rolled = leaf_mesh_of("f_curvature n 0 90 0.5 170 0.55 215 1 220");
  const MeshQuality quality = mesh_quality(rolled);
  ASSERT_EQ(quality.crossings.size(), 1u);
  EXPECT_EQ(rolled.organs[quality.crossings[0].organ].label, "l1");
  EXPECT_EQ(quality.crossings[0].organ, quality.crossings[0].other);
  EXPECT_GT(quality.crossings[0].l, 0.49);
  EXPECT_GT(quality.crossings[0].at_m.z(), 0.049);  // the leaf stands upright, 10 cm long
  EXPECT_FALSE(mesh_quality(leaf_mesh_of("f_inclination n 0 0 1 800 f_azimuth n 0 0 1 1")).crossings.empty());
}

TEST(MeshQuality, SaysWhichOrgansCross) {
  const Plant plant = parse_plant("p.bpms",
                                  "units cm s[+l][+l] s { a_length 5 a_radius 0.3 } + 2 { a_twist 90 }\n"
                                  "l { a_length 10 a_width 3 f_inclination n 0 90 1 90 }");
  MeshQualityOptions between;
  between.between_organs = true;
  const Mesh mesh = plant_mesh(plant);
  EXPECT_TRUE(mesh_quality(mesh).crossings.empty());
  const std::vector<MeshCrossing> crossings = mesh_quality(mesh, between).crossings;
  // Both leaves lie in the plane of the stem's upper lid, over each other and over the lid.
  std::vector<std::string> pairs;
  for (const MeshCrossing& c : crossings)
    pairs.push_back(mesh.organs[c.organ].label + mesh.organs[c.other].label);
  EXPECT_THAT(pairs, testing::UnorderedElementsAre("s1l1", "s1l2", "l1l2"));
}

// Two organs of a triangle each, at right angles: they have an edge in common, or go through each other.
TEST(MeshQuality, TellsTouchingFromCrossing) {
  MeshQualityOptions between;
  between.between_organs = true;
  for (const float low : {0.0f, -0.01f, 0.01f}) {
    Mesh mesh;
    mesh.positions_m = {{0, 0, 0},         {1, 0, 0},         {0.5f, 1, 0},
                        {0.2f, 0.2f, low}, {0.7f, 0.2f, low}, {0.5f, 0.2f, 1}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    mesh.organ_of_triangle = {0, 1};
    mesh.organs.resize(2);
    EXPECT_EQ(mesh_quality(mesh, between).crossings.size(), low < 0 ? 1u : 0u) << low;
    EXPECT_TRUE(mesh_quality(mesh).crossings.empty());
  }
}

TEST(MeshQuality, MeasuresTriangles) {
  Mesh mesh;
  mesh.positions_m = {{0, 0, 0},    {1, 0, 0}, {0.5f, 0.8660254f, 0}, {2, 0.001f, 0}, {0.5f, -1, 0},
                      {0.5f, 0, 1}, {3, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.organs.emplace_back();
  EXPECT_NEAR(mesh_quality(mesh).smallest_angle_deg, 60, 1e-5);
  EXPECT_NEAR(mesh_quality(mesh).largest_aspect, 1, 1e-6);
  mesh.triangles.push_back({0, 3, 1});  // a sliver: 0.001 high, 2 long
  EXPECT_EQ(mesh_quality(mesh).slivers, 1u);
  EXPECT_NEAR(mesh_quality(mesh).largest_aspect, 2 / 0.0005 * std::sqrt(3.0) / 2, 10);
  mesh.triangles.push_back({1, 0, 2});  // once more, the other way round
  EXPECT_EQ(mesh_quality(mesh).duplicate_faces, 1u);
  mesh.triangles = {{0, 1, 2}, {0, 1, 4}, {0, 1, 5}};
  EXPECT_EQ(mesh_quality(mesh).non_manifold_edges, 1u);
  mesh.triangles = {{0, 1, 6}};
  EXPECT_EQ(mesh_quality(mesh).degenerate, 1u);
}

FacetOrientation leaf_facets(const Mesh& mesh) {
  FacetOrientation out;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.organs[mesh.organ_of_triangle[t]].kind == "leaf") out.add(triangle_area_vector(mesh, t));
  return out;
}

TEST(MeshLevels, KeepAreaAndAnglesWithFewerTriangles) {
  const Plant plant = read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms");
  const std::vector<MeshLevel> levels = mesh_levels(plant, {1e-4}, 4);
  ASSERT_EQ(levels.size(), 4u);
  const FacetOrientation finest = leaf_facets(levels[0].mesh);
  EXPECT_EQ(levels[0].deviation_m, 0);
  for (std::size_t k = 1; k < levels.size(); ++k) {
    EXPECT_DOUBLE_EQ(levels[k].tolerance_m, 1e-4 * std::pow(4, k));
    EXPECT_LT(levels[k].mesh.triangles.size(), levels[k - 1].mesh.triangles.size());
    const FacetOrientation coarse = leaf_facets(levels[k].mesh);
    EXPECT_NEAR(coarse.area(), finest.area(), 1e-3 * finest.area());
    EXPECT_NEAR(degrees(coarse.mean_inclination()), degrees(finest.mean_inclination()), 2) << k;
    EXPECT_NEAR(coarse.g(0), finest.g(0), 0.02) << k;
    // Either is within its tolerance of the surface.
    EXPECT_LT(levels[k].deviation_m, levels[k].tolerance_m + levels[0].tolerance_m);
    EXPECT_GT(levels[k].deviation_m, 0);
  }
}

}  // namespace
}  // namespace bpms
