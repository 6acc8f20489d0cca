// Prototypes made of others: nested = written out = taken apart, whole plants are told from their parts, and
// cycles are refused with their chain.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/geometry/assemble.h"
#include "scene/intersect/intersector.h"
#include "tests/data.h"
#include "tests/scene/shapes.h"

namespace bpms {
namespace {

// Shoots (discs, a strip, a twig) on branches on trees, scaled and tilted at each step.
struct Forest {
  Scene scene = test::empty_scene(8, true);
  std::vector<Assembly> assemblies;

  Forest() {
    Philox random(21);
    scene.materials = {"leaf", "soil", "bark", "needle"};
    Prototype shoot = test::disc_prototype(test::scattered_discs(random, 12, 0.15, 0.3, 0.04f));
    shoot.mesh = test::bent_strip(4, 0.4f, 0.1f, 0.1f);
    shoot.material_of_organ = {0};
    shoot.shapes = {cylinder({0, 0, 0}, {0, 0, 0.35}, 0.02, 0.01, true, 2), sphere({0, 0.1, 0.35}, 0.03, 3)};
    scene.prototypes = {shoot};
    Prototype trunk;
    trunk.name = "trunk";
    trunk.shapes = {cylinder({0, 0, 0}, {0, 0, 2}, 0.1, 0.05, true, 2)};
    scene.prototypes.push_back(trunk);
    Assembly branch{"branch", {}}, tree{"tree", {{1, {0, 0, 0}, 0, 1}}};
    for (int k = 0; k < 5; ++k)
      branch.parts.push_back({0, {0.2 * k, 0, 0}, Rotation::about_axes(k, 0.4 * k, -0.2 * k), 1 - 0.1 * k});
    for (int k = 0; k < 6; ++k)
      tree.parts.push_back({2, {0, 0, 0.6 + 0.2 * k}, Rotation::about_axes(1.1 * k, -0.5, 0.3), 0.9});
    assemblies = {branch, tree};
    for (int k = 0; k < 7; ++k) {
      const Eigen::Vector3d at(random.uniform(-4, 4), random.uniform(-4, 4), 0);
      scene.instances.push_back(
          {3, at, random.uniform(0, 6), random.uniform(0.7, 1.3), static_cast<std::uint32_t>(k)});
    }
    scene.ground = Ground{0, 1};
  }
  Scene resolved(AssemblyLayout layout) const {
    Scene out = scene;
    resolve_assemblies(assemblies, layout, out);
    return out;
  }
};

TEST(Nested, IsTheSameApartAndWrittenOut) {
  const Forest forest;
  const Scene apart = forest.resolved(AssemblyLayout::apart),
              whole = forest.resolved(AssemblyLayout::written_out);
  EXPECT_EQ(apart.instances.size(), 7u * 31);
  EXPECT_EQ(whole.instances.size(), 7u);
  EXPECT_EQ(apart.prototypes.size(), 2u);
  for (const std::uint64_t flatten_below : {0ull, 1'000'000ull}) {
    const Intersector a(apart, {1000, flatten_below, 0}), b(whole, {1000, flatten_below, 0});
    Philox random(22);
    int different = 0, hits = 0;
    constexpr int rays = 20'000;
    for (int k = 0; k < rays; ++k) {
      const Eigen::Vector3d o(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(0, 3));
      const Ray ray{o.cast<float>(), test::random_direction(random), 1e30f, {}};
      Hit x, y;
      const Escape first = a.intersect(ray, x), second = b.intersect(ray, y);
      if (first != second || (first == Escape::hit && std::abs(x.distance - y.distance) > 1e-4)) {
        ++different;
        continue;
      }
      if (first != Escape::hit || x.ground) continue;
      ++hits;
      EXPECT_EQ(x.material, y.material);
      EXPECT_EQ(x.front, y.front);
      EXPECT_LT((x.position - y.position).norm(), 2e-5);
      // Float rays are off by some 1e-6 m here, on spheres of 1 cm: 1e-4 in angle, more where they graze.
      EXPECT_LT((x.geometric_normal - y.geometric_normal).norm(), 2e-3);
      EXPECT_LT((x.shading_normal - y.shading_normal).norm(), 2e-3);
      EXPECT_LT((x.uv - y.uv).norm(), 2e-3) << x.id.geometry;
      EXPECT_LT((x.dp_du - y.dp_du).norm(), 1e-3 * (1 + x.dp_du.norm()));
      EXPECT_LT((x.dp_dv - y.dp_dv).norm(), 1e-3 * (1 + x.dp_dv.norm()));
      EXPECT_EQ(a.plant_of(x.id), b.plant_of(y.id));
      EXPECT_LT(a.plant_of(x.id), 7u);
      EXPECT_EQ(a.plant_of(x.id), x.id.instance / 31);
    }
    EXPECT_LT(different, rays / 500);  // silhouettes, at scales down to the twigs' ends
    EXPECT_GT(hits, rays / 10);
  }
}

TEST(Nested, PlacesPartsAsTheirChainSays) {
  // x first, then y, then z: a tip at z = 1, tilted about x by 90 degrees points to -y, turned about z by 90
  // degrees to +x; then doubled and moved.
  const Instance inner{0, {0, 0, 1}, 0, 0.5},
      outer{1, {10, 0, 0}, Rotation::about_axes(pi / 2, 0, pi / 2), 2};
  const Instance both = within(outer, inner);
  EXPECT_LT((both.position_m - Eigen::Vector3d(12, 0, 0)).norm(), 1e-6);
  EXPECT_EQ(both.scale, 1);
  EXPECT_LT((both.rotation * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-6);
  // y after x: z goes to -y by x, which y leaves as it is.
  const Rotation two = Rotation::about_axes(0, pi / 2, pi / 2);
  EXPECT_LT((two * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(0, -1, 0)).norm(), 1e-6);
  EXPECT_LT((two * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0, 0, -1)).norm(), 1e-6);
  EXPECT_LT((two.back(two * Eigen::Vector3d(1, 2, 3)) - Eigen::Vector3d(1, 2, 3)).norm(), 1e-6);
}

TEST(Nested, IsWrittenOutWhereThatIsSmaller) {
  // Many placements of something small: one prototype. Few of something large: instances.
  Scene scene = test::empty_scene(8, true);
  Philox random(23);
  scene.prototypes = {test::disc_prototype(test::scattered_discs(random, 10, 0.1, 0.1, 0.01f)),
                      test::disc_prototype(test::scattered_discs(random, 5'000, 0.1, 0.1, 0.01f))};
  std::vector<Assembly> assemblies(2);
  assemblies[0].name = "small", assemblies[1].name = "large";
  for (int k = 0; k < 20; ++k) {
    assemblies[0].parts.push_back({0, {0.1 * k, 0, 0}, 0, 1});
    assemblies[1].parts.push_back({1, {0.1 * k, 0, 0}, 0, 1});
  }
  for (int k = 0; k < 100; ++k)
    scene.instances.push_back({static_cast<std::uint32_t>(2 + k % 2), {0, 0, 0}, 0, 1});
  resolve_assemblies(assemblies, scene);
  EXPECT_EQ(scene.instances.size(), 50u + 50u * 20);
  ASSERT_EQ(scene.prototypes.size(), 3u);
  EXPECT_EQ(scene.prototypes[2].name, "small");
  EXPECT_EQ(scene.prototypes[2].discs.size(), 200u);
}

const std::string head = R"([domain]
size_m = [10, 10]
[materials.leaf]
[materials.soil]
[ground]
type = "plane"
material = "soil"
[prototypes.shoot]
discs = "crown.def"
material = "leaf"
)";

class NestedFile : public ::testing::Test {
 protected:
  NestedFile() {
    std::string discs;  // enough of them not to be written out
    for (int k = 0; k < 50; ++k) discs += "0.1 0 0 1 0 0 1\n";
    folder.write("crown.def", discs);
  }
  Scene read(const std::string& text) {
    return read_scene_geometry(TomlDocument::read(folder.write("scene.toml", head + text)));
  }
  test::TemporaryFolder folder;
};

TEST_F(NestedFile, IsReadToAnyDepthInAnyOrder) {
  folder.write("six.def", "0 0 0 90 0 90\n");
  const Scene scene = read(R"([prototypes.a_forest]
parts = [{ prototype = "tree", positions = [[0, 0, 0], [1, 0, 0, 90]] }]
[prototypes.tree]
parts = [
  { prototype = "branch", positions = "six.def", scale = 2 },
  { prototype = "shoot", positions = [[0, 0, 3]] },
]
[prototypes.branch]
parts = [{ prototype = "shoot", positions = [[0, 0, 1], [0, 0, 2]], rotation_deg = 10 }]
[[instances]]
prototype = "a_forest"
positions = [[0, 0, 0]]
[[instances]]
prototype = "shoot"
positions = [[3, 3, 0]]
)");
  ASSERT_EQ(scene.instances.size(), 7u);  // 2 trees of 3 shoots, and one
  EXPECT_TRUE(scene.notes.empty());
  // The branch is doubled and its z points to +x: shoots at 2 and 4 m.
  EXPECT_LT((scene.instances[0].position_m - Eigen::Vector3d(2, 0, 0)).norm(), 1e-6);
  EXPECT_LT((scene.instances[1].position_m - Eigen::Vector3d(4, 0, 0)).norm(), 1e-6);
  EXPECT_LT((scene.instances[2].position_m - Eigen::Vector3d(0, 0, 3)).norm(), 1e-6);
  EXPECT_EQ(scene.instances[0].scale, 2);
  // The second tree is turned by a quarter.
  EXPECT_LT((scene.instances[3].position_m - Eigen::Vector3d(1, 2, 0)).norm(), 1e-6);
  for (std::size_t k = 0; k < 7; ++k) EXPECT_EQ(scene.instances[k].plant, k < 6 ? 0u : 1u);
}

TEST_F(NestedFile, NamesWhatIsWrong) {
  const std::string stands = "[[instances]]\nprototype = \"a\"\npositions = [[0, 0, 0]]\n";
  const auto part = [](const char* name, const char* of) {
    return fmt::format("[prototypes.{}]\nparts = [{{ prototype = \"{}\", positions = [[0, 0, 1]] }}]\n", name,
                       of);
  };
  BPMS_EXPECT_ERROR(read(part("a", "b") + part("b", "c") + part("c", "b") + stands), ErrorKind::bad_input,
                    "scene.toml:14:9: prototypes contain each other: b > c > b");
  BPMS_EXPECT_ERROR(read(part("a", "a") + stands), ErrorKind::bad_input, "a > a");
  BPMS_EXPECT_ERROR(read(part("a", "shot") + stands), ErrorKind::bad_input, "did you mean 'shoot'");
  BPMS_EXPECT_ERROR(read("[prototypes.a]\nparts = []\n" + stands), ErrorKind::bad_input, "no parts");
  BPMS_EXPECT_ERROR(read("[prototypes.a]\nparts = [{ prototype = \"shoot\" }]\n" + stands),
                    ErrorKind::bad_input, "missing key 'positions'");
  BPMS_EXPECT_ERROR(
      read(part("a", "shoot") + "discs = \"crown.def\"\n" + stands), ErrorKind::bad_input,
      "scene.toml:13:9: prototypes.a.discs: a prototype with `parts` has no geometry of its own");
  folder.write("five.def", "0 0 0\n0 0 0 1 2\n");
  BPMS_EXPECT_ERROR(read("[[instances]]\nprototype = \"shoot\"\npositions = \"five.def\"\n"),
                    ErrorKind::bad_input, "five.def:2: 5 columns, expected 3, 4 or 6");
  // Ten to the twelve instances by five steps of 250.
  std::string steps, row;
  for (int k = 0; k < 250; ++k) row += "0 0 0\n";
  folder.write("many.def", row);
  for (const char* step : {"a:b", "b:c", "c:d", "d:e", "e:big"})
    steps += fmt::format("[prototypes.{}]\nparts = [{{ prototype = \"{}\", positions = \"many.def\" }}]\n",
                         std::string(step).substr(0, 1), std::string(step).substr(2));
  std::string strip;
  for (int k = 0; k < 3000; ++k) strip += "0.1 0 0 1 0 0 1\n";
  folder.write("big.def", strip);
  steps += "[prototypes.big]\ndiscs = \"big.def\"\nmaterial = \"leaf\"\n";
  BPMS_EXPECT_ERROR(read(steps + stands), ErrorKind::missing_resource, "3.91e+09 instances");
}

TEST_F(NestedFile, NotesWhatNothingIsMadeOf) {
  const Scene scene =
      read("[prototypes.tree]\nparts = [{ prototype = \"shoot\", positions = [[0, 0, 0]] }]\n");
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_THAT(scene.notes[0], ::testing::HasSubstr("[prototypes.tree] stands nowhere"));
}

}  // namespace
}  // namespace bpms
