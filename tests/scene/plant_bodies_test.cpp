// Plants whose stems, buds and heads are solids against the same of triangles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/random.h"
#include "scene/importers/plants.h"
#include "scene/intersect/intersector.h"
#include "scene/structure/structure.h"
#include "tests/scene/shapes.h"

namespace bpms {
namespace {

constexpr const char* stems_text =
    "units cm\n[sbs[+s]h]\n"
    "s 1 { material culm a_length 20 a_radius 0.8 f_inclination n 0 0 1 50 a_joint 1.3 }\n"
    "b { material node a_radius 1 }\n"
    "s { material culm a_length 15 a_radius 0.6 f_width n 0 1 1 0.6 f_inclination s 0 0 0.5 30 1 -20 }\n"
    "+ { a_twist 80 a_inclination 40 }\n"
    "h { material ear a_length 8 a_radius 1 f_inclination n 0 0 1 40 }\n";

enum class Bodies { shapes, triangles };

Scene stand(const std::string& text, Bodies bodies) {
  Scene scene = test::empty_scene(0, false);
  scene.materials.clear();
  MaterialNames names(scene);
  const Plant plant = parse_plant("stems.bpms", text);
  MeshOptions how = traced_plants();
  how.bodies = bodies == Bodies::triangles;
  scene.prototypes.push_back(plant_prototype(plant, "stems", "", nullptr, {}, names, how));
  scene.instances.emplace_back();
  return scene;
}

TEST(PlantBodies, AreShapesThatBelongToTheirOrgans) {
  const Prototype solids = stand(stems_text, Bodies::shapes).prototypes[0];
  EXPECT_TRUE(solids.mesh->triangles.empty());
  ASSERT_EQ(solids.organ_of_shape.size(), solids.shapes.size());
  ASSERT_EQ(solids.mesh->organs.size(), 5u);
  for (std::size_t k = 0; k < solids.shapes.size(); ++k)
    EXPECT_EQ(solids.shapes[k].material, solids.material_of_organ[solids.organ_of(k)]);
  const Prototype triangles = stand(stems_text, Bodies::triangles).prototypes[0];
  EXPECT_TRUE(triangles.shapes.empty());
  for (std::size_t k = 0; k < 5; ++k) {
    // Facets within 1e-4 m of radii of 4 to 10 mm.
    const double area = solids.mesh->organs[k].area_m2;
    EXPECT_NEAR(triangles.mesh->organs[k].area_m2, area, 0.01 * area) << k;
  }
}

TEST(PlantBodies, HaveTheStructureOfTheirTriangles) {
  StructureOptions options;
  options.gaps.rays = 1 << 14;
  const CanopyStructure solids = canopy_structure(stand(stems_text, Bodies::shapes), options);
  options.gaps.seed = 2;
  const CanopyStructure triangles = canopy_structure(stand(stems_text, Bodies::triangles), options);
  for (const char* material : {"culm", "node", "ear"}) {
    const double area = triangles.surface.materials.at(material).other_m2;
    EXPECT_NEAR(solids.surface.materials.at(material).other_m2, area, 0.01 * area) << material;
  }
  EXPECT_NEAR(solids.height_m, triangles.height_m, 2e-4);
  // The ground areas are hulls of the plan view, a tolerance apart: what is covered is compared.
  ASSERT_EQ(solids.gaps.size(), triangles.gaps.size());
  for (std::size_t k = 0; k < solids.gaps.size(); ++k) {
    const Gap &a = solids.gaps[k], &b = triangles.gaps[k];
    const double covered_a = (1 - a.plant.p) * solids.ground_area_m2,
                 covered_b = (1 - b.plant.p) * triangles.ground_area_m2;
    const double error = std::hypot(a.plant.standard_error * solids.ground_area_m2,
                                    b.plant.standard_error * triangles.ground_area_m2);
    // Four standard errors of nineteen comparisons, and the facets' share.
    EXPECT_NEAR(covered_a, covered_b, 4 * error + 2e-3 * covered_b) << a.zenith_deg();
  }
}

// From outside nothing but fronts is seen, and what is seen is where the triangles are.
TEST(PlantBodies, LetNoRayIn) {
  const Scene solid_scene = stand(stems_text, Bodies::shapes);
  const Scene triangle_scene = stand(stems_text, Bodies::triangles);
  const Intersector solids(solid_scene), triangles(triangle_scene);
  Philox random(7, 1);
  int both = 0, one = 0;
  for (int k = 0; k < 200000; ++k) {
    const Eigen::Vector3f direction = test::random_direction(random);
    const Eigen::Vector3d aim(random.uniform(-0.02, 0.25), random.uniform(-0.1, 0.1), random.uniform(0, 0.4));
    Ray ray;
    ray.origin = aim.cast<float>() - 2 * direction;
    ray.direction = direction;
    Hit hit, other;
    const bool met = solids.intersect(ray, hit) == Escape::hit;
    if (met) {
      EXPECT_TRUE(hit.front);
      EXPECT_LT(hit.organ, 5u);
    }
    const bool met_too = triangles.intersect(ray, other) == Escape::hit;
    one += met != met_too ? 1 : 0;
    if (!met || !met_too) continue;
    ++both;
    // At grazing angles a hair's breadth is a long way along the ray.
    const double sine = std::abs(hit.geometric_normal.dot(direction));
    if (sine > 0.3 && hit.organ == other.organ) {
      EXPECT_NEAR(hit.distance, other.distance, 2e-3);
    }
  }
  EXPECT_GT(both, 3000);
  EXPECT_LT(one, both / 20);  // outlines a tolerance apart
}

}  // namespace
}  // namespace bpms
