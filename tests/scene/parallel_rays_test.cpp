// Rays of one direction through the plane grid give what the hierarchy gives.
#include "scene/intersect/parallel_rays.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "core/units.h"
#include "scene/intersect/look_ahead.h"

namespace bpms {
namespace {

// Three crowns; turned and scaled alike, they are flattened once.
Scene random_scene(bool periodic, bool alike) {
  Philox random(3, 1);
  Scene scene;
  scene.domain.periodic = periodic;
  scene.domain.size_m = {3, 2};
  scene.materials = {"leaf", "soil"};
  Prototype crown;
  for (int i = 0; i < 1500; ++i) {
    const double z = random.uniform(-1, 1), azimuth = random.uniform(0, 2 * pi), s = std::sqrt(1 - z * z);
    const Eigen::Vector3d centre(random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8),
                                 random.uniform(0.1, 1));
    crown.discs.push_back({centre.cast<float>(), static_cast<float>(random.uniform(0.01, 0.08)),
                           Eigen::Vector3d(s * std::cos(azimuth), s * std::sin(azimuth), z).cast<float>()});
  }
  scene.prototypes.push_back(std::move(crown));
  for (int i = 0; i < 3; ++i) {
    Instance instance;
    instance.position_m = {0.9 * i - 1, 0.5 * i - 0.3, 0.2 * i};
    // The first stands upright.
    instance.rotation = alike ? Rotation(0.7) : Rotation::about_axes(0.7 * i, 0.3 * i, -0.2 * i);
    instance.scale = alike ? 1.2 : 1 + 0.2 * i;
    scene.instances.push_back(instance);
  }
  scene.ground = Ground{0.0, 1};
  return scene;
}

void expect_the_same(bool periodic, bool alike, double zenith) {
  const Scene scene = random_scene(periodic, alike);
  const Intersector intersector(scene);
  const Eigen::Vector3d towards = direction_from_angles(zenith, 1.1, scene.domain);
  const auto rays = intersector.parallel_rays(scene, towards);
  ASSERT_NE(rays, nullptr);
  Philox random(9, 2);
  constexpr int count = 20000;
  int other_hit = 0, other_shadow = 0, occluded = 0;
  for (int i = 0; i < count; ++i) {
    Ray ray;
    ray.origin = Eigen::Vector3d(random.uniform(-1.5, 1.5), random.uniform(-1, 1), 3).cast<float>();
    ray.direction = (-towards).cast<float>();
    Hit a, b;
    ASSERT_EQ(intersector.intersect(ray, a), Escape::hit);
    ASSERT_TRUE(rays->first(ray.origin, b));
    if (a.id.instance != b.id.instance || a.id.geometry != b.id.geometry ||
        a.id.primitive != b.id.primitive) {
      ++other_hit;
    } else {
      // A float's rounding of the place, 3e-7 here, is drawn out where the disc is nearly seen edge-on.
      const float cosine = std::abs(a.geometric_normal.dot(ray.direction));
      EXPECT_NEAR(a.distance, b.distance, std::max(1e-4f, 3e-7f / cosine));
      EXPECT_LT((a.geometric_normal - b.geometric_normal).norm(), 1e-6);
      EXPECT_EQ(a.front, b.front);
      EXPECT_EQ(a.material, b.material);
    }
    // A shadow ray from wherever a ray in some other direction ends.
    ray.direction = Eigen::Vector3d(random.normal(), random.normal(), -std::abs(random.normal()))
                        .normalized()
                        .cast<float>();
    if (intersector.intersect(ray, a) != Escape::hit) continue;
    Ray shadow;
    shadow.origin = a.position;
    shadow.direction = towards.cast<float>();
    shadow.from = a.id;
    const bool blocked = intersector.occluded(shadow);
    occluded += blocked;
    other_shadow += blocked != rays->occluded(a.position, a.id);
  }
  // Edges of discs may fall either way by rounding.
  EXPECT_LT(other_hit, count / 2000);
  EXPECT_LT(other_shadow, count / 2000);
  EXPECT_GT(occluded, count / 20);
}

TEST(ParallelRays, AgreeWithTheHierarchyInAPeriodicCell) {
  for (const bool alike : {false, true}) {
    expect_the_same(true, alike, 0);
    expect_the_same(true, alike, radians(50));
    expect_the_same(true, alike, radians(75));  // shadows fall several periods away
  }
}

TEST(ParallelRays, AgreeWithTheHierarchyInAnOpenScene) {
  for (const bool alike : {false, true}) expect_the_same(false, alike, radians(30));
}

TEST(LookAhead, GivesEachRaysOwnLookAlsoWhereSomeAreLeftOut) {
  const Scene scene = random_scene(true, false);
  const Intersector intersector(scene);
  const auto rays = intersector.parallel_rays(scene, Eigen::Vector3d::UnitZ());
  ASSERT_NE(rays, nullptr);
  Philox random(4, 4);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 300; ++i)
    points.push_back(Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), 2).cast<float>());
  LookAhead ahead(*rays, points.size());
  // One after the other, then some left out, then more than it looks ahead.
  for (std::size_t i = 0, step = 1; i < points.size(); i += step, step = i < 100 ? 1 : i < 200 ? 3 : 40) {
    const ParallelRays::Look &look = ahead.at(i, [&](std::size_t k) { return points[k]; }),
                             expected = rays->look(points[i]);
    EXPECT_EQ(look.at, expected.at) << i;
    EXPECT_EQ(look.spot.square, expected.spot.square) << i;
  }
}

}  // namespace
}  // namespace bpms
