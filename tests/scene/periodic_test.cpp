// The periodic cell against the same canopy laid out in many tiles, and rays that run along it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/geometry/random_discs.h"
#include "scene/intersect/intersector.h"
#include "tests/data.h"
#include "tests/scene/shapes.h"

namespace bpms {
namespace {

constexpr IntersectorOptions flat{}, instanced{1000, 0};

TEST(Periodic, SeesAStraddlingInstanceOnBothSidesOfTheCell) {
  Scene scene = test::empty_scene(4, true);
  scene.prototypes = {test::disc_prototype({{{0, 0, 0}, 0.5f, {0, 0, 1}}})};
  scene.instances.push_back({0, {1.9, -1.9, 1}, 0, 1});
  scene.ground = Ground{0, 1};
  for (const IntersectorOptions& options : {flat, instanced}) {
    const Intersector intersector(scene, options);
    const auto covered = [&](float x, float y) {
      Hit hit;
      EXPECT_EQ(intersector.intersect({{x, y, 5}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
      EXPECT_LE(hit.position.cwiseAbs().head<2>().maxCoeff(), 2);
      EXPECT_EQ(hit.id.instance, 0u);
      return !hit.ground;
    };
    EXPECT_TRUE(covered(1.9f, -1.9f));
    EXPECT_TRUE(covered(1.5f, -1.9f));
    EXPECT_TRUE(covered(-1.7f, -1.9f));  // over the east side
    EXPECT_TRUE(covered(1.9f, 1.7f));    // over the south side
    EXPECT_TRUE(covered(-1.8f, 1.8f));   // over the corner
    EXPECT_FALSE(covered(-1.55f, -1.9f));
    EXPECT_FALSE(covered(-1.65f, 1.65f));
    EXPECT_FALSE(covered(0, 0));
  }
}

TEST(Periodic, IsALargeTiling) {
  RandomDiscs what;
  what.size_m = {3, 2};
  what.radius_m = 0.15;
  what.lai = 0.6;
  what.top_m = 1;
  what.bottom_m = 0.2;
  const Scene periodic = random_disc_scene(what);
  Scene tiles = periodic;
  tiles.domain.periodic = false;
  tiles.instances.clear();
  for (int x = -12; x <= 12; ++x)
    for (int y = -12; y <= 12; ++y) tiles.instances.push_back({0, {3.0 * x, 2.0 * y, 0}, 0, 1});
  const Intersector all(tiles);
  for (const IntersectorOptions& options : {flat, instanced}) {
    const Intersector cell(periodic, options);
    Philox random(1);
    int different = 0, far_hits = 0;
    constexpr int rays = 20000;
    for (int k = 0; k < rays; ++k) {
      const double zenith = radians(random.uniform(0, 86));
      const double azimuth = random.uniform(0, 2 * pi);
      Eigen::Vector3f d = direction_from_angles(zenith, azimuth, periodic.domain).cast<float>();
      if (k % 2) d.z() = -d.z();
      const Ray ray{Eigen::Vector3d(random.uniform(-1.5, 1.5), random.uniform(-1, 1), random.uniform(0, 1))
                        .cast<float>(),
                    d,
                    1e30f,
                    {}};
      Hit a, b;
      const Escape one = cell.intersect(ray, a), two = all.intersect(ray, b);
      EXPECT_EQ(cell.occluded(ray), one == Escape::hit);
      if (one != two || a.id.primitive != b.id.primitive || std::abs(a.distance - b.distance) > 1e-3) {
        ++different;
        continue;
      }
      if (one == Escape::hit && a.distance > 2) ++far_hits;
    }
    EXPECT_LT(different, rays / 2000);  // silhouettes
    EXPECT_GT(far_hits, 100);           // rays that changed sides did meet things
  }
}

TEST(Periodic, LeavesFromCopiesOfTheSameElement) {
  // A ray that leaves a level disc at the border in its own plane meets the disc's image one cell away at no
  // distance short of that; one that leaves upwards never meets it again.
  Scene scene = test::empty_scene(1, true);
  scene.prototypes = {test::disc_prototype({{{0.49f, 0, 0.5f}, 0.1f, {0, 0, 1}}})};
  scene.instances.emplace_back();
  for (const IntersectorOptions& options : {flat, instanced}) {
    const Intersector intersector(scene, options);
    for (const float x : {0.45f, -0.45f}) {
      Hit hit, next;
      ASSERT_EQ(intersector.intersect({{x, 0, 2}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
      for (const float slope : {1e-4f, 1e-3f, 0.1f}) {
        for (const float way : {1.0f, -1.0f}) {
          const Ray ray{hit.position, Eigen::Vector3f(way, 0, slope).normalized(), 1e30f, hit.id};
          EXPECT_EQ(intersector.intersect(ray, next), Escape::top);
          EXPECT_FALSE(intersector.occluded(ray));
        }
      }
    }
  }
}

TEST(Periodic, GivesUpOnLevelRaysAfterTheAllowedWraps) {
  Scene scene = test::empty_scene(2, true);
  scene.prototypes = {test::disc_prototype({{{0, 0, 0.5f}, 0.1f, {1, 0, 0}}})};
  scene.instances.emplace_back();
  scene.ground = Ground{0, 1};
  const Intersector intersector(scene);
  Hit hit;
  EXPECT_EQ(intersector.intersect({{0, 0.7f, 0.5f}, {1, 0, 0}, 1e30f, {}}, hit), Escape::wrap_limit);
  EXPECT_FALSE(intersector.occluded({{0, 0.7f, 0.5f}, {1, 0, 0}, 1e30f, {}}));
  // Very flat rays do meet the ground in the end, at the right distance.
  const Eigen::Vector3f d = Eigen::Vector3f(1, 0, -0.001f).normalized();
  ASSERT_EQ(intersector.intersect({{0, 0.7f, 0.5f}, d, 1e30f, {}}, hit), Escape::hit);
  EXPECT_TRUE(hit.ground);
  EXPECT_NEAR(hit.distance, 500, 0.01);
}

TEST(Periodic, ClipsRaysThatComeFromFarAbove) {
  Scene scene = test::empty_scene(2, true);
  scene.prototypes = {test::disc_prototype({{{0, 0, 0.5f}, 0.1f, {0, 0, 1}}})};
  scene.instances.emplace_back();
  const Intersector intersector(scene, {10, 100'000});
  const Eigen::Vector3f d = Eigen::Vector3f(0.6f, 0, -0.8f);
  Hit hit;
  // 300 cells on the way: no wrap is spent on the empty part.
  ASSERT_EQ(intersector.intersect({Eigen::Vector3f(0, 0, 0.5f) - 1000 * d, d, 1e30f, {}}, hit), Escape::hit);
  EXPECT_NEAR(hit.distance, 1000, 1e-3);
  EXPECT_EQ(intersector.intersect({{0, 0, 5}, {0, 0, 1}, 1e30f, {}}, hit), Escape::top);
}

TEST(Periodic, NeedsASize) {
  Scene scene = test::empty_scene(0, true);
  BPMS_EXPECT_ERROR(Intersector{scene}, ErrorKind::bad_input, "size_m");
}

}  // namespace
}  // namespace bpms
