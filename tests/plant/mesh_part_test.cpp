#include "plant/mesh_part.h"

#include <gtest/gtest.h>

namespace bpms {
namespace {

// Two organs, a triangle each, with one vertex in common.
Mesh two_organs() {
  Mesh mesh;
  for (int k = 0; k < 5; ++k) {
    mesh.positions_m.emplace_back(static_cast<float>(k), 0.f, static_cast<float>(k % 2));
    mesh.normals.emplace_back(0.f, 1.f, 0.f);
    mesh.uv.emplace_back(static_cast<float>(k), 0.5f);
  }
  mesh.triangles = {{0, 1, 2}, {2, 3, 4}};
  mesh.organ_of_triangle = {0, 1};
  mesh.organs.resize(2);
  mesh.organs[0].label = "s1", mesh.organs[1].label = "l1";
  return mesh;
}

TEST(MeshPart, HasTheTrianglesOfTheWantedOrgansAndTheirVerticesAlone) {
  const Mesh whole = two_organs();
  const Mesh part = mesh_part(whole, [](std::uint32_t organ) { return organ == 1; });
  ASSERT_EQ(part.triangles.size(), 1u);
  EXPECT_EQ(part.organ_of_triangle, std::vector<std::uint32_t>{1});
  ASSERT_EQ(part.positions_m.size(), 3u);
  ASSERT_EQ(part.normals.size(), 3u);
  ASSERT_EQ(part.uv.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(part.positions_m[part.triangles[0][k]], whole.positions_m[whole.triangles[1][k]]);
    EXPECT_EQ(part.uv[part.triangles[0][k]], whole.uv[whole.triangles[1][k]]);
  }
  // The rows of the organs keep their numbers.
  ASSERT_EQ(part.organs.size(), 2u);
  EXPECT_EQ(part.organs[1].label, "l1");
}

TEST(MeshPart, OfNothingIsEmpty) {
  const Mesh part = mesh_part(two_organs(), [](std::uint32_t) { return false; });
  EXPECT_TRUE(part.triangles.empty());
  EXPECT_TRUE(part.positions_m.empty());
}

}  // namespace
}  // namespace bpms
