#include "scene/structure/without_materials.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/geometry/shape.h"
#include "scene/structure/facets.h"
#include "tests/scene/shapes.h"

namespace bpms {
namespace {

TEST(WithoutMaterials, LeavesOutDiscsAndShapesOfThem) {
  Scene scene = test::empty_scene(0, false);
  Prototype prototype = test::disc_prototype({{{0, 0, 1}, 0.1f, {0, 0, 1}}, {{0, 0, 2}, 0.2f, {0, 0, 1}}});
  prototype.material_of_disc = {1, 0};
  prototype.shapes = {cylinder({0, 0, 0}, {0, 0, 1}, 0.01, 0.01), cylinder({1, 0, 0}, {1, 0, 2}, 0.01, 0.01)};
  prototype.shapes[0].material = 0, prototype.shapes[1].material = 1;
  scene.prototypes.push_back(prototype);
  const Prototype left = without_materials(scene, {"soil"}).prototypes[0];
  ASSERT_EQ(left.discs.size(), 1u);
  EXPECT_EQ(left.discs[0].radius_m, 0.2f);
  EXPECT_EQ(left.material_of_disc, std::vector<std::uint32_t>{0});
  ASSERT_EQ(left.shapes.size(), 1u);
  EXPECT_EQ(left.shapes[0].size_m[2], 1);
}

TEST(WithoutMaterials, LeavesOutOrgansAndNumbersTheRest) {
  Scene scene = test::empty_scene(0, false);
  auto mesh = std::make_shared<Mesh>(*test::bent_strip(4, 0.2f, 0.02f, 0.01f));
  mesh->organs.push_back(mesh->organs[0]);
  mesh->organs[1].label = "l2";
  for (std::size_t t = 4; t < 8; ++t) mesh->organ_of_triangle[t] = 1;
  Prototype prototype = test::mesh_prototype(mesh);
  prototype.material_of_organ = {1, 0};
  scene.prototypes.push_back(prototype);
  const Prototype left = without_materials(scene, {"soil"}).prototypes[0];
  ASSERT_EQ(left.mesh->organs.size(), 1u);
  EXPECT_EQ(left.mesh->organs[0].label, "l2");
  EXPECT_EQ(left.mesh->triangles.size(), 4u);
  EXPECT_EQ(left.mesh->organ_of_triangle, std::vector<std::uint32_t>(4, 0));
  EXPECT_EQ(left.material_of_organ, std::vector<std::uint32_t>{0});
}

TEST(WithoutMaterials, NamesTheNearestOfAWrongName) {
  try {
    without_materials(test::empty_scene(0, false), {"sol"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("soil"), std::string::npos) << error.what();
  }
}

// Two closed cylinders, one upon the other, that are one organ: of its ends one looks down and one up, and
// the two between them are inside.
TEST(Facets, OfAChainHaveTheEndsOfTheChainAlone) {
  Prototype prototype;
  auto mesh = std::make_shared<Mesh>();
  mesh->organs.resize(1);
  mesh->organs[0].kind = "stem";
  constexpr double radius = 0.02, length = 0.1;
  mesh->organs[0].area_m2 = 2 * pi * radius * (2 * length + radius);
  prototype.mesh = mesh;
  prototype.material_of_organ = {0};
  prototype.shapes = {cylinder({0, 0, 0}, {0, 0, length}, radius, radius),
                      cylinder({0, 0, length}, {0, 0, 2 * length}, radius, radius)};
  prototype.organ_of_shape = {0, 0};
  double up = 0, down = 0, sides = 0;
  visit_facets(prototype, [&](const Facet& facet) {
    const double z = facet.area_vector.z(), area = facet.area_vector.norm();
    (z > 0.5 * area ? up : z < -0.5 * area ? down : sides) += area;
  });
  const double end = pi * radius * radius;
  EXPECT_NEAR(up, end, 1e-5 * end);
  EXPECT_NEAR(down, end, 1e-5 * end);
  EXPECT_NEAR(sides, 4 * pi * radius * length, 1e-5 * sides);
}

}  // namespace
}  // namespace bpms
