// Discs in cells are met as the hierarchy meets them: from above, from within, from disc to disc.
#include "scene/intersect/disc_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/units.h"

namespace bpms {
namespace {

Eigen::Vector3f random_direction(Philox& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized().cast<float>();
}

// Discs all through a block, in instances that are turned, scaled and stand across the cell's border.
Scene block(bool periodic, std::optional<double> ground_m) {
  Philox random(17, 4);
  Scene scene;
  scene.domain.periodic = periodic;
  scene.domain.size_m = {3, 2};
  scene.materials = {"leaf", "other", "soil"};
  for (int p = 0; p < 2; ++p) {
    Prototype& part = scene.prototypes.emplace_back();
    part.disc_material = static_cast<std::uint32_t>(p);
    for (int i = 0; i < 1500; ++i) {
      const Eigen::Vector3d centre(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 1));
      part.discs.push_back(
          {centre.cast<float>(), static_cast<float>(random.uniform(0.01, 0.08)), random_direction(random)});
    }
  }
  for (int i = 0; i < 4; ++i) {
    Instance instance;
    instance.prototype = static_cast<std::uint32_t>(i % 2);
    if (periodic) {
      instance.position_m = {-0.9 + 0.5 * i, 0.5 * i - 0.8, 0.1 * i};
      instance.rotation = i == 0 ? Rotation(0.7) : Rotation::about_axes(0.7 * i, 0.1 * i, -0.2 * i);
    } else {  // nearer, or most of the box is empty
      instance.position_m = {0.2 * i - 0.3, 0.1 * i, 0.1 * i};
      instance.rotation = i == 0 ? Rotation(0.1) : Rotation::about_axes(0.1 * i, 0.02 * i, -0.03 * i);
    }
    instance.scale = 1 + 0.1 * i;
    scene.instances.push_back(instance);
  }
  if (ground_m) scene.ground = Ground{*ground_m, 2};
  return scene;
}

struct Differences {
  int rays = 0, other = 0, shadows = 0, met = 0;
};

// Rays that go on from what they meet; both are asked the same each time.
Differences compare(const Scene& scene, const Intersector& grid, const Intersector& hierarchy, float far) {
  Philox random(5, 1);
  Differences out;
  for (int path = 0; path < 6000; ++path) {
    Ray ray;
    ray.origin =
        Eigen::Vector3d(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-0.5, 3)).cast<float>();
    ray.direction = random_direction(random);
    ray.far = far;
    for (int step = 0; step < 5; ++step) {
      Hit a, b;
      ++out.rays;
      const Escape met = grid.intersect(ray, a), expected = hierarchy.intersect(ray, b);
      const bool same = met == expected && (met != Escape::hit || (a.id.instance == b.id.instance &&
                                                                   a.id.geometry == b.id.geometry &&
                                                                   a.id.primitive == b.id.primitive));
      if (!same) ++out.other;
      if (grid.occluded(ray) != hierarchy.occluded(ray)) ++out.shadows;
      if (!same || met != Escape::hit) break;
      ++out.met;
      const float cosine = std::abs(a.geometric_normal.dot(ray.direction));
      // The hierarchy lifts a start off its disc by some 1e-5, which is drawn out where a disc is nearly seen
      // edge-on; metres of way are rounded too.
      const float tolerance = 1e-5f / cosine + 1e-6f * a.distance;
      EXPECT_NEAR(a.distance, b.distance, tolerance);
      Eigen::Vector3f apart = a.position - b.position;
      if (scene.domain.periodic)
        for (int axis = 0; axis < 2; ++axis) {
          const auto size = static_cast<float>(scene.domain.size_m[axis]);
          apart[axis] -= size * std::round(apart[axis] / size);
        }
      EXPECT_LT(apart.norm(), tolerance);
      EXPECT_LT((a.geometric_normal - b.geometric_normal).norm(), 1e-6f);
      EXPECT_EQ(a.front, b.front);
      EXPECT_EQ(a.ground, b.ground);
      EXPECT_EQ(a.material, b.material);
      EXPECT_NEAR(a.extent, b.extent, 1e-6f);
      ray.origin = b.position;
      ray.from = b.id;
      ray.direction = random_direction(random);
    }
  }
  return out;
}

void expect_the_same(bool periodic, std::optional<double> ground_m, float far = 1e30f) {
  SCOPED_TRACE(testing::Message() << (periodic ? "periodic" : "open") << ", ground "
                                  << (ground_m ? std::to_string(*ground_m) : "none") << ", far " << far);
  const Scene scene = block(periodic, ground_m);
  IntersectorOptions without;
  without.disc_grid = false;
  const Intersector grid(scene), hierarchy(scene, without);
  ASSERT_GT(grid.memory_bytes(), hierarchy.memory_bytes()) << "no grid was made";
  const Differences found = compare(scene, grid, hierarchy, far);
  // Edges of discs may fall either way by rounding.
  EXPECT_LT(found.other, found.rays / 1000);
  EXPECT_LT(found.shadows, found.rays / 1000);
  EXPECT_GT(found.met, 1000);
}

TEST(DiscGrid, AgreesWithTheHierarchyInAPeriodicCell) {
  expect_the_same(true, std::nullopt);
  expect_the_same(true, 0.0);
  expect_the_same(true, 0.6);   // among the discs
  expect_the_same(true, -0.5);  // beneath them
}

TEST(DiscGrid, AgreesWithTheHierarchyInAnOpenScene) {
  expect_the_same(false, std::nullopt);
  expect_the_same(false, 0.0);
  expect_the_same(false, 0.6);
}

TEST(DiscGrid, RaysEndWhereTheyAreToldTo) {
  expect_the_same(true, 0.0, 0.4f);
  expect_the_same(false, 0.0, 0.4f);
}

TEST(DiscGrid, LevelRaysAlongAnAxisWalkRoundAndRound) {
  const Scene scene = block(true, 0.0);
  IntersectorOptions without;
  without.disc_grid = false;
  const Intersector grid(scene), hierarchy(scene, without);
  for (const Eigen::Vector3f& direction : {Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, -1, 0),
                                           Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(0, 0, -1)}) {
    int met = 0;
    for (int i = 0; i < 200; ++i) {
      Ray ray;
      ray.origin = {-1.4f + 0.013f * static_cast<float>(i), 0.01f, 0.02f + 0.005f * static_cast<float>(i)};
      ray.direction = direction;
      Hit a, b;
      ASSERT_EQ(grid.intersect(ray, a), hierarchy.intersect(ray, b));
      if (a.id.primitive == b.id.primitive) ++met;
    }
    EXPECT_GE(met, 199);
  }
}

// A disc's own copy one period on is not the disc that the ray left.
TEST(DiscGrid, MeetsTheNextCopyOfItsOwnDisc) {
  Scene scene;
  scene.domain.size_m = {1, 1};
  scene.materials = {"leaf"};
  Prototype& many = scene.prototypes.emplace_back();
  many.discs.push_back({{0, 0, 0.5f}, 0.2f, {1, 0, 0}});
  // Others, so that there is a grid; all above and below the ray.
  Philox random(1, 1);
  for (int i = 0; i < 4000; ++i) {
    const double z = i % 2 == 0 ? random.uniform(0, 0.35) : random.uniform(0.65, 1);
    many.discs.push_back(
        {Eigen::Vector3d(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), z).cast<float>(),
         0.05f,
         {0, 0, 1}});
  }
  scene.instances.emplace_back();
  const Intersector intersector(scene);
  Ray down{{-0.4f, 0.03f, 0.5f}, {1, 0, 0}, 1e30f, {}, Eigen::Vector3f::Zero(), -1};
  Hit first, again;
  ASSERT_EQ(intersector.intersect(down, first), Escape::hit);
  EXPECT_NEAR(first.distance, 0.4f, 1e-6f);
  const Ray on{first.position, {1, 0, 0}, 1e30f, first.id, first.geometric_normal, first.extent};
  ASSERT_EQ(intersector.intersect(on, again), Escape::hit);
  EXPECT_NEAR(again.distance, 1.0f, 1e-6f);
  EXPECT_EQ(again.id.primitive, first.id.primitive);
}

TEST(DiscGrid, IsNotMadeWhereMostIsEmpty) {
  Scene scene = block(true, 0.0);
  scene.domain.size_m = {300, 200};
  IntersectorOptions without;
  without.disc_grid = false;
  EXPECT_EQ(Intersector(scene).memory_bytes(), Intersector(scene, without).memory_bytes());
}

TEST(DiscGrid, TakesOnlyWhatALimitLeaves) {
  const Scene scene = block(true, 0.0);
  IntersectorOptions tight, wide;
  tight.most_bytes = Intersector(scene).estimated_bytes() + 10'000;
  wide.most_bytes = tight.most_bytes + 10'000'000;
  EXPECT_LT(Intersector(scene, tight).memory_bytes(), Intersector(scene, wide).memory_bytes());
}

}  // namespace
}  // namespace bpms
