#include "scene/intersect/intersector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/scene/shapes.h"

namespace bpms {
namespace {

using test::empty_scene;

constexpr IntersectorOptions flat{}, instanced{1000, 0};

Scene disc_above_ground() {
  Scene scene = empty_scene(4, false);
  scene.prototypes = {test::disc_prototype({{{0, 0, 0}, 0.5f, {0, 0, 1}}})};
  scene.instances.push_back({0, {1, 0, 1}, 0, 1});
  scene.ground = Ground{0, 1};
  return scene;
}

TEST(Intersector, KnowsTheFacesOfADiscByItsNormal) {
  const Intersector intersector(disc_above_ground());
  Hit hit;
  ASSERT_EQ(intersector.intersect({{1, 0.1f, 5}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
  EXPECT_TRUE(hit.front);
  EXPECT_FALSE(hit.ground);
  EXPECT_FLOAT_EQ(hit.distance, 4);
  EXPECT_EQ(hit.material, 0u);
  ASSERT_EQ(intersector.intersect({{1, 0.1f, 0.5f}, {0, 0, 1}, 1e30f, {}}, hit), Escape::hit);
  EXPECT_FALSE(hit.front);
  EXPECT_FLOAT_EQ(hit.geometric_normal.z(), 1);  // of the upper face, whichever was met
}

TEST(Intersector, MeetsTheGroundFarOutsideAnOpenScene) {
  const Intersector intersector(disc_above_ground());
  Hit hit;
  ASSERT_EQ(intersector.intersect({{5000, -3000, 7}, {0.6f, 0, -0.8f}, 1e30f, {}}, hit), Escape::hit);
  EXPECT_TRUE(hit.ground);
  EXPECT_EQ(hit.material, 1u);
  EXPECT_FLOAT_EQ(hit.distance, 7 / 0.8f);
  EXPECT_FLOAT_EQ(hit.position.x(), 5000 + 7 * 0.75f);
  EXPECT_EQ(hit.position.z(), 0);
  // From the ground itself: up and away.
  EXPECT_EQ(intersector.intersect({hit.position, {0, 0, 1}, 1e30f, hit.id}, hit), Escape::top);
  EXPECT_EQ(intersector.intersect({{0, 0, -1}, {0, 0, -1}, 1e30f, {}}, hit), Escape::bottom);
}

// A bare plane at 0 m is a slab of no thickness: rays brought down to its top must not be found beneath it.
TEST(Intersector, MeetsABarePlaneFromEveryDirection) {
  for (const bool periodic : {true, false})
    for (const double height_m : {0.0, 2.5}) {
      Scene scene = empty_scene(2, periodic);
      scene.ground = Ground{height_m, 1};
      const Intersector intersector(scene);
      int met = 0;
      for (int zenith = 0; zenith < 85; ++zenith) {
        const double t = radians(zenith);
        Hit hit;
        const auto above = static_cast<float>(height_m + 1e-4);
        const Ray ray{{0.3f, 0.2f, above},
                      {static_cast<float>(std::sin(t)), 0, static_cast<float>(-std::cos(t))},
                      1e30f,
                      {}};
        met += intersector.intersect(ray, hit) == Escape::hit && hit.ground;
      }
      EXPECT_EQ(met, 85) << (periodic ? "periodic, " : "open, ") << height_m;
    }
}

TEST(Intersector, StopsAtFar) {
  const Intersector intersector(disc_above_ground());
  const Eigen::Vector3f origin(1, 0, 5), down(0, 0, -1);
  EXPECT_FALSE(intersector.occluded({origin, down, 3.99f, {}}));
  EXPECT_TRUE(intersector.occluded({origin, down, 4.01f, {}}));
  EXPECT_FALSE(intersector.occluded({{0, 0, 5}, down, 4.99f, {}}));
  EXPECT_TRUE(intersector.occluded({{0, 0, 5}, down, 5.01f, {}}));
}

TEST(Intersector, TurnsInstancesCounterClockwiseSeenFromAbove) {
  // A disc to the east of the prototype's origin stands to the north after a quarter turn.
  Scene scene = empty_scene(100, false);
  scene.prototypes = {test::disc_prototype({{{2, 0, 0}, 0.5f, {0, 0, 1}}})};
  scene.instances.push_back({0, {10, 20, 1}, radians(90), 3});
  for (const IntersectorOptions& options : {flat, instanced}) {
    const Intersector intersector(scene, options);
    Hit hit;
    EXPECT_EQ(intersector.intersect({{10, 26, 9}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
    EXPECT_EQ(intersector.intersect({{10, 27.4f, 9}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
    EXPECT_EQ(intersector.intersect({{10, 14, 9}, {0, 0, -1}, 1e30f, {}}, hit), Escape::bottom);
    EXPECT_EQ(intersector.intersect({{16, 20, 9}, {0, 0, -1}, 1e30f, {}}, hit), Escape::bottom);
  }
}

// Two ways to hold the same scene: written out, and as instances.
TEST(Intersector, FindsTheSameInFlatAndInstancedScenes) {
  Scene scene = empty_scene(20, true);
  Philox random(3);
  const std::vector<Disc> discs = test::scattered_discs(random, 300, 1, 2, 0.08f);
  scene.prototypes = {test::disc_prototype(discs), test::mesh_prototype(test::bent_strip(20, 3, 0.3f, 1))};
  for (int k = 0; k < 60; ++k)
    scene.instances.push_back({static_cast<std::uint32_t>(k % 2),
                               {random.uniform(-10, 10), random.uniform(-10, 10), random.uniform(0, 1)},
                               Rotation::about_axes(random.uniform(0, 2 * pi), k % 3 * 0.4, k % 5 * -0.3),
                               random.uniform(0.5, 1.5)});
  scene.ground = Ground{0, 1};
  IntersectorOptions written_out;
  written_out.flatten_below = 1'000'000;
  const Intersector a(scene, written_out), b(scene, instanced);
  int hits = 0, different = 0;
  constexpr int rays = 20000;
  for (int k = 0; k < rays; ++k) {
    const Ray ray{
        Eigen::Vector3d(random.uniform(-10, 10), random.uniform(-10, 10), random.uniform(0, 4)).cast<float>(),
        test::random_direction(random),
        1e30f,
        {}};
    Hit first, second;
    const Escape one = a.intersect(ray, first), two = b.intersect(ray, second);
    EXPECT_EQ(a.occluded(ray), one == Escape::hit);
    // At a silhouette rounding may decide one way or the other.
    if (one != two || (one == Escape::hit && first.id.primitive != second.id.primitive)) {
      ++different;
      continue;
    }
    if (one != Escape::hit) continue;
    ++hits;
    EXPECT_EQ(first.id.instance, second.id.instance);
    EXPECT_EQ(first.id.geometry, second.id.geometry);
    EXPECT_EQ(first.front, second.front);
    EXPECT_NEAR(first.distance, second.distance, 1e-4 * (1 + first.distance));
    EXPECT_NEAR((first.geometric_normal - second.geometric_normal).norm(), 0, 1e-5);
  }
  EXPECT_GT(hits, rays / 2);
  EXPECT_LT(different, rays / 1000);
}

TEST(Intersector, PutsHitsOnThePrimitiveTenKilometresOut) {
  // Float coordinates of 1e4 m step by 1e-3 m: the hit is the nearest point to that on the disc's plane.
  constexpr double far_m = 1e4;
  Scene scene = empty_scene(4 * far_m, false);
  Philox random(5);
  std::vector<Disc> discs = test::scattered_discs(random, 200, 5, 10, 0.5f);
  scene.prototypes = {test::disc_prototype(discs)};
  scene.instances.push_back({0, {far_m, -far_m, 0}, 0, 1});
  for (const IntersectorOptions& options : {flat, instanced}) {
    const Intersector intersector(scene, options);
    int hits = 0;
    for (int k = 0; k < 2000; ++k) {
      const Eigen::Vector3d at(far_m + random.uniform(-5, 5), -far_m + random.uniform(-5, 5), 0);
      const Eigen::Vector3f direction = (Eigen::Vector3d(0.2, 0.1, -1).normalized()).cast<float>();
      Hit hit;
      if (intersector.intersect({(at - 12 * direction.cast<double>()).cast<float>(), direction, 1e30f, {}},
                                hit) != Escape::hit)
        continue;
      ++hits;
      double nearest = 1e9;
      for (const Disc& disc : discs) {
        const Eigen::Vector3d offset =
            hit.position.cast<double>() - disc.centre_m.cast<double>() - Eigen::Vector3d(far_m, -far_m, 0);
        if (offset.norm() < disc.radius_m + 2e-3)
          nearest = std::min(nearest, std::abs(offset.dot(disc.normal.cast<double>())));
      }
      EXPECT_LT(nearest, 2e-3);  // two float steps, 2e-7 of the distance
    }
    EXPECT_GT(hits, 200);
  }
}

// Rays that start on a surface, as a path does: they may meet neighbours, never the primitive they left.
void expect_no_self_hits(const Scene& scene, const IntersectorOptions& options, std::uint64_t seed) {
  const Intersector intersector(scene, options);
  const Eigen::Vector2f low = intersector.cell_low_m(), high = intersector.cell_high_m();
  Philox random(seed);
  int starts = 0;
  for (int k = 0; k < 4000; ++k) {
    const Eigen::Vector3f origin(static_cast<float>(random.uniform(low.x(), high.x())),
                                 static_cast<float>(random.uniform(low.y(), high.y())),
                                 intersector.top_m() + 1);
    Hit hit;
    if (intersector.intersect({origin, {0, 0, -1}, 1e30f, {}}, hit) != Escape::hit || hit.ground) continue;
    ++starts;
    const Eigen::Vector3f n = hit.geometric_normal;
    const Eigen::Vector3f across = n.unitOrthogonal();
    // All directions, and ones that graze the surface on either side.
    for (const float lift : {0.0f, 1e-7f, -1e-7f, 1e-5f, -1e-5f, 1e-3f, -1e-3f, 0.3f, -0.3f, 1.0f, -1.0f}) {
      const Ray ray{hit.position, (across + lift * n).normalized(), 1e30f, hit.id};
      Hit next;
      if (intersector.intersect(ray, next) != Escape::hit) {
        EXPECT_FALSE(intersector.occluded(ray));
        continue;
      }
      if (next.id.primitive == hit.id.primitive && next.id.instance == hit.id.instance && !next.ground) {
        // Only the shifted image of itself may be met, a cell away.
        EXPECT_TRUE(scene.domain.periodic);
        EXPECT_GT(next.distance, 0.5 * scene.domain.size_m.minCoeff()) << "lift " << lift;
      }
    }
  }
  EXPECT_GT(starts, 100);
}

TEST(Intersector, NeverMeetsTheDiscItLeaves) {
  Philox random(11);
  for (const double offset : {0.0, 1e2, 1e4}) {
    Scene scene = empty_scene(0, false);
    std::vector<Disc> discs = test::scattered_discs(random, 50, 1, 1, 0.3f);
    scene.prototypes = {test::disc_prototype(discs)};
    for (const Rotation& rotation : {Rotation(1), Rotation::about_axes(1, 2, 3)}) {
      scene.instances = {{0, {offset, -offset, 0}, rotation, 1}};
      expect_no_self_hits(scene, flat, 1);
      expect_no_self_hits(scene, instanced, 2);
    }
  }
  // Leaves of 1 mm, ten kilometres out.
  Scene scene = empty_scene(0, false);
  std::vector<Disc> discs;
  for (int k = 0; k < 2000; ++k)
    discs.push_back(
        {Eigen::Vector3d(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), random.uniform(0, 1))
             .cast<float>(),
         0.001f, test::random_direction(random)});
  scene.prototypes = {test::disc_prototype(discs)};
  scene.instances.push_back({0, {1e4, 1e4, 0}, 0, 1});
  expect_no_self_hits(scene, instanced, 3);
}

TEST(Intersector, NeverMeetsTheTriangleItLeaves) {
  for (const double offset : {0.0, 1e2, 1e4}) {
    Scene scene = empty_scene(0, false);
    scene.prototypes = {test::mesh_prototype(test::bent_strip(64, 4, 0.5f, 0.7f))};
    for (const Rotation& rotation : {Rotation(0.3), Rotation::about_axes(0.3, 0.5, -0.4)}) {
      scene.instances = {{0, {offset, offset, 0}, rotation, 1}};
      expect_no_self_hits(scene, flat, 4);
      expect_no_self_hits(scene, instanced, 5);
    }
  }
}

TEST(Intersector, LeavesTheConvexSideOfABentLeafFreely) {
  // From the lower side of a strip that curves up nothing of the strip can be met, neighbours included.
  Scene scene = empty_scene(0, false);
  scene.prototypes = {test::mesh_prototype(test::bent_strip(64, 4, 0.5f, 0.7f))};
  scene.instances.push_back({0, {50, 50, 0}, 0.3, 1});
  Philox random(9);
  for (const IntersectorOptions& options : {flat, instanced}) {
    const Intersector intersector(scene, options);
    int starts = 0, met = 0;
    for (int k = 0; k < 5000; ++k) {
      const Eigen::Vector3f origin(static_cast<float>(random.uniform(48, 52)),
                                   static_cast<float>(random.uniform(48, 52)), 9);
      Hit hit;
      if (intersector.intersect({origin, {0, 0, -1}, 1e30f, {}}, hit) != Escape::hit) continue;
      ++starts;
      Eigen::Vector3f d = test::random_direction(random);
      if (d.dot(hit.geometric_normal) > 0) d = -d;
      met += intersector.occluded({hit.position, d, 1e30f, hit.id});
    }
    EXPECT_GT(starts, 500);
    EXPECT_EQ(met, 0);
  }
}

TEST(Intersector, KeepsShadingNormalsOnTheSideThatIsSeen) {
  Scene scene = empty_scene(0, false);
  scene.prototypes = {test::mesh_prototype(test::bent_strip(3, 4, 0.5f, 2))};  // coarse: normals differ much
  scene.instances.emplace_back();
  const Intersector intersector(scene);
  Philox random(13);
  int hits = 0;
  for (int k = 0; k < 20000; ++k) {
    const Eigen::Vector3f d = test::random_direction(random);
    const Eigen::Vector3f target(static_cast<float>(random.uniform(-2, 2)),
                                 static_cast<float>(random.uniform(-0.3, 0.3)),
                                 static_cast<float>(random.uniform(0, 2)));
    Hit hit;
    if (intersector.intersect({target - 6 * d, d, 1e30f, {}}, hit) != Escape::hit) continue;
    ++hits;
    const float seen = hit.front ? -1.0f : 1.0f;
    EXPECT_GE(seen * hit.geometric_normal.dot(d), 0);
    EXPECT_GT(seen * hit.shading_normal.dot(d), 0);
    EXPECT_NEAR(hit.shading_normal.norm(), 1, 1e-5);
    EXPECT_EQ(hit.organ, 0u);
  }
  EXPECT_GT(hits, 1000);
}

TEST(Intersector, MeetsAnEmptySceneNowhere) {
  Scene scene = empty_scene(1, true);
  Hit hit;
  EXPECT_EQ(Intersector(scene).intersect({{0, 0, 1}, {0, 0, -1}, 1e30f, {}}, hit), Escape::bottom);
  scene.ground = Ground{0.25, 1};
  const Intersector bare(scene);
  ASSERT_EQ(bare.intersect({{0.1f, 0.2f, 1.25f}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
  EXPECT_FLOAT_EQ(hit.distance, 1);
  EXPECT_EQ(bare.top_m(), 0.25f);
}

}  // namespace
}  // namespace bpms
