// Material maps and bumps in the file.
#include "simulate/simulate.h"
#include "tests/materials/materials_of.h"

namespace bpms::test {
namespace {

const std::string blade = R"([materials.lamina]
type = "bilambertian"
reflectance = 0.1
transmittance = 0.1
[materials.vein]
type = "lambertian"
reflectance = 0.2
[materials.hole]
type = "transparent"
[materials.leaf]
type = "map"
)";

class MapFiles : public ::testing::Test {
 protected:
  MapFiles() {
    folder_.write("two.pgm", "P2\n2 2\n255\n0 1\n1 0\n");
    folder_.write("far.pgm", "P2\n2 2\n255\n0 255\n7 0\n");
  }
  TemporaryFolder folder_;
};

TEST_F(MapFiles, NameMaterialsByIndex) {
  const Materials all =
      materials_of(folder_, blade + "file = \"two.pgm\"\nmaterials = [\"lamina\", \"vein\"]\n", {650});
  const Material& leaf = all["leaf"];
  ASSERT_TRUE(leaf.map);
  EXPECT_THAT(leaf.map_materials, ::testing::ElementsAre("lamina", "vein"));
  EXPECT_THAT(leaf.map->values(), ::testing::ElementsAre(0, 1, 1, 0));
  EXPECT_FALSE(leaf.opaque);
  EXPECT_FALSE(leaf.is_diffuse());
  EXPECT_THAT(all.inputs, ::testing::ElementsAre(folder_ / "two.pgm"));
}

TEST_F(MapFiles, NameMaterialsByValue) {
  const Materials all = materials_of(
      folder_, blade + "file = \"far.pgm\"\nmaterials = { 0 = \"lamina\", 255 = \"vein\", 7 = \"hole\" }\n",
      {650});
  const Material& leaf = all["leaf"];
  std::vector<std::string> names;
  for (const float index : leaf.map->values())
    names.push_back(leaf.map_materials.at(static_cast<std::size_t>(index)));
  EXPECT_THAT(names, ::testing::ElementsAre("lamina", "vein", "hole", "lamina"));
}

TEST_F(MapFiles, BringTheirMaterialsIntoTheScene) {
  const std::string scene =
      blade +
      "file = \"two.pgm\"\nmaterials = [\"lamina\", \"vein\"]\n"
      "[ground]\ntype = \"plane\"\nmaterial = \"leaf\"\n[domain]\nsize_m = [1, 1]\n"
      "[illumination]\nsky = { type = \"isotropic\", radiance = 1.0 }\n"
      "[[sensors]]\nname = \"a\"\ntype = \"brf\"\nviews = [[0, 0]]\n[sampling]\nsamples = 64\n";
  const Simulation simulation = parse_simulation(folder_ / "scene.toml", scene);
  EXPECT_THAT(simulation.scene.materials, ::testing::ElementsAre("leaf", "lamina", "vein"));
  ASSERT_EQ(simulation.materials.size(), 3u);
  EXPECT_TRUE(simulation.materials[0].map);
  EXPECT_EQ(simulation.materials[2].name, "vein");
}

TEST_F(MapFiles, WithMistakesGetOneLine) {
  struct Case {
    const char* rest;
    ErrorKind kind;
    const char* message;
  };
  const Case cases[] = {
      {"file = \"far.pgm\"\nmaterials = [\"lamina\", \"vein\"]", ErrorKind::bad_input,
       "far.pgm: pixel 2 of row 1 is 255, which `materials` does not name"},
      {"file = \"two.pgm\"\nmaterials = [\"lamina\", \"vien\"]", ErrorKind::bad_input, "no [materials.vien]"},
      {"file = \"two.pgm\"\nmaterials = [\"lamina\", \"leaf\"]", ErrorKind::bad_input, "made of itself"},
      {"file = \"two.pgm\"\nmaterials = [\"lamina\", \"bumpy\"]", ErrorKind::bad_input,
       "give the bump to the map"},
      {"file = \"two.pgm\"\nmaterials = { a = \"lamina\" }", ErrorKind::bad_input, "names no value"},
      {"file = \"two.pgm\"\nmaterials = []", ErrorKind::bad_input, "at least one material"},
      {"materials = [\"lamina\"]", ErrorKind::bad_input, "missing key"},
      {"file = \"none.pgm\"\nmaterials = [\"lamina\"]", ErrorKind::missing_resource, "none.pgm"},
  };
  const std::string bumpy =
      "\n[materials.bumpy]\ntype = \"lambertian\"\nreflectance = 0.1\n"
      "bump = { file = \"two.pgm\", height_m = 0.001 }\n";
  for (const Case& c : cases) {
    SCOPED_TRACE(c.rest);
    BPMS_EXPECT_ERROR(materials_of(folder_, blade + c.rest + bumpy, {650}), c.kind, c.message);
  }
}

TEST_F(MapFiles, GiveBumpsToAnyMaterial) {
  folder_.write("veins.csv", "0 0.5\n1 0\n");
  const Material bumpy = material_of(
      folder_,
      "type = \"lambertian\"\nreflectance = 0.1\nbump = { file = \"veins.csv\", height_m = 0.0002 }");
  ASSERT_TRUE(bumpy.bump);
  EXPECT_EQ(bumpy.bump_m, 0.0002);
  EXPECT_THAT(bumpy.bump->values(), ::testing::ElementsAre(0, 0.5f, 1, 0));
  EXPECT_FALSE(bumpy.is_diffuse());
  BPMS_EXPECT_ERROR(
      material_of(folder_, "type = \"lambertian\"\nreflectance = 0.1\nbump = { file = \"veins.csv\" }"),
      ErrorKind::bad_input, "height_m");
}

}  // namespace
}  // namespace bpms::test
