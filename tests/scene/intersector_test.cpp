#include "scene/intersect/intersector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bpms {
namespace {

Scene one_disc(bool periodic) {
  Scene scene;
  scene.domain.size_m = {4, 4};
  scene.domain.periodic = periodic;
  scene.materials = {"leaf", "soil"};
  Prototype prototype;
  prototype.name = "disc";
  prototype.discs = {{{0, 0, 0}, 0.5f, {0, 0, 1}}};
  scene.prototypes = {prototype};
  Instance instance;
  instance.position_m = {1.9, 0, 1};
  scene.instances = {instance};
  scene.ground = Ground{0, 1};
  return scene;
}

TEST(Intersector, MeetsADiscFromAboveAndBelow) {
  const Scene scene = one_disc(false);
  const Intersector intersector(scene);
  Hit hit;
  EXPECT_EQ(intersector.intersect({{1.9f, 0.1f, 5}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
  EXPECT_TRUE(hit.front);
  EXPECT_FALSE(hit.ground);
  EXPECT_FLOAT_EQ(hit.distance, 4);
  EXPECT_EQ(intersector.intersect({{1.9f, 0.1f, 0.5f}, {0, 0, 1}, 1e30f, {}}, hit), Escape::hit);
  EXPECT_FALSE(hit.front);
  EXPECT_EQ(intersector.intersect({{0, 0.1f, 5}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
  EXPECT_TRUE(hit.ground);
  EXPECT_EQ(hit.material, 1u);
}

TEST(Intersector, SeesAStraddlingDiscOnBothSidesOfTheCell) {
  const Scene scene = one_disc(true);
  for (const std::uint64_t limit : {0ull, 1000ull}) {
    IntersectorOptions options;
    options.flatten_below = limit;
    const Intersector intersector(scene, options);
    for (const float x : {1.5f, 1.99f, -1.99f, -1.65f}) {
      Hit hit;
      EXPECT_EQ(intersector.intersect({{x, 0.1f, 5}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
      EXPECT_FALSE(hit.ground) << x;
    }
    Hit hit;
    intersector.intersect({{-1.55f, 0.1f, 5}, {0, 0, -1}, 1e30f, {}}, hit);
    EXPECT_TRUE(hit.ground);
  }
}

}  // namespace
}  // namespace bpms
