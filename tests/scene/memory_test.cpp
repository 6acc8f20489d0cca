// What a scene takes is estimated before it is built, and refused above a limit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/intersect/intersector.h"
#include "tests/data.h"
#include "tests/scene/shapes.h"

namespace bpms {
namespace {

Scene many(const Prototype& prototype, int instances) {
  Scene scene = test::empty_scene(100, false);
  scene.prototypes = {prototype};
  Philox random(1);
  for (int k = 0; k < instances; ++k) {
    const Eigen::Vector3d at(random.uniform(-50, 50), random.uniform(-50, 50), 0);
    scene.instances.push_back({0, at, Rotation::about_axes(random.uniform(0, 6), 0.1, 0.2), 1});
  }
  return scene;
}

TEST(Memory, IsEstimatedBeforeItIsTaken) {
  // Within a factor of 2 of what is counted, for each kind of primitive and for instances: Embree counts in
  // blocks, and leaves out a part of an instance (memory_bytes says so).
  Philox random(2);
  const Prototype discs = test::disc_prototype(test::scattered_discs(random, 100'000, 1, 1, 0.01f));
  const Prototype mesh = test::mesh_prototype(test::bent_strip(50'000, 1, 1, 1));
  Prototype shapes, one = test::disc_prototype({{{0, 0, 0}, 0.1f, {0, 0, 1}}});
  for (int k = 0; k < 50'000; ++k) {
    const Eigen::Vector3d at(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    shapes.shapes.push_back(sphere(at, 0.001));
  }
  const std::pair<const char*, Scene> scenes[] = {{"discs", many(discs, 1)},
                                                  {"mesh", many(mesh, 1)},
                                                  {"shapes", many(shapes, 1)},
                                                  {"one", many(one, 50'000)}};
  for (const auto& [name, scene] : scenes) {
    SCOPED_TRACE(name);
    IntersectorOptions options;
    options.flatten_below = 1;
    const Intersector intersector(scene, options);
    const auto taken = static_cast<double>(intersector.memory_bytes());
    const auto expected = static_cast<double>(intersector.estimated_bytes());
    RecordProperty(name, std::to_string(taken) + " " + std::to_string(expected));
    EXPECT_GT(expected, 0.5 * taken) << taken;
    EXPECT_LT(expected, 2 * taken) << taken;
  }
}

TEST(Memory, IsLimited) {
  Prototype strip = test::mesh_prototype(test::bent_strip(50'000, 1, 1, 1));
  strip.name = "oak";
  const Scene scene = many(strip, 20);
  IntersectorOptions options;
  options.flatten_below = 10'000'000;  // written out: 2 million triangles
  options.most_bytes = 100u << 20;
  BPMS_EXPECT_ERROR(Intersector(scene, options), ErrorKind::missing_resource,
                    "most of it goes to prototype 'oak'");
  BPMS_EXPECT_ERROR(Intersector(scene, options), ErrorKind::missing_resource, "the limit is 0.0977 GiB");
  options.flatten_below = 0;  // the same as instances fits
  EXPECT_LT(Intersector(scene, options).memory_bytes(), options.most_bytes);
}

}  // namespace
}  // namespace bpms
