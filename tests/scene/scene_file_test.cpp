#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/units.h"
#include "plant/leaf_patches.h"
#include "scene/importers/disc_list.h"
#include "scene/importers/mesh_file.h"
#include "scene/importers/patch_file.h"
#include "scene/intersect/intersector.h"
#include "scene/scene.h"
#include "tests/data.h"
#include "tests/scene_text.h"

namespace bpms {
namespace {

const std::string good = R"([domain]
size_m = [10.0, 8.0]
boundary = "periodic"
azimuth_convention = "east_counterclockwise"
[materials.leaf]
type = "bilambertian"
[materials.soil]
type = "lambertian"
[ground]
type = "plane"
height_m = 0.5
material = "soil"
[prototypes.crown]
discs = "crown.def"
material = "leaf"
[[instances]]
prototype = "crown"
positions = "where.def"
[[instances]]
prototype = "crown"
positions = [[1, 2, 3], [1, 2, 4, 180]]
scale = 2
)";

// Of an upright instance, in [0, 2 pi); float quaternions are good to 1e-7.
double turned_about_z(const Instance& instance) {
  EXPECT_TRUE(instance.rotation.upright());
  const Eigen::Vector3d x = instance.rotation * Eigen::Vector3d::UnitX();
  const double angle = std::atan2(x.y(), x.x());
  return angle < 0 ? angle + 2 * pi : angle;
}

class SceneFile : public ::testing::Test {
 protected:
  SceneFile() {
    folder.write("crown.def", "# radius x y z nx ny nz\n0.1 0 0 1 0 0 2\n0.2 1 0 1 1 0 0\n");
    folder.write("where.def", "0 0 0\n5 5 0 90\n");
    folder.write("leaf.obj", "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("grass.bpms",
                 "units cm\n[s[l]]\ns { material stem a_length 10 a_radius 0.2 }\n"
                 "l { material leaf a_length 20 a_width 2 f_inclination n 0 20 1 60 }\n");
  }
  Scene read(const std::string& text) {
    return read_scene_geometry(TomlDocument::read(folder.write("scene.toml", text)));
  }
  // The good file with one piece replaced.
  Scene read_with(const std::string& piece, const std::string& other) {
    std::string text = good;
    const std::size_t at = text.find(piece);
    EXPECT_NE(at, std::string::npos) << piece;
    return read(text.replace(at, piece.size(), other));
  }
  test::TemporaryFolder folder;
};

TEST_F(SceneFile, IsReadInFull) {
  const Scene scene = read(good);
  EXPECT_EQ(scene.domain.size_m, Eigen::Vector2d(10, 8));
  EXPECT_TRUE(scene.domain.periodic);
  EXPECT_FALSE(scene.domain.azimuth_north_clockwise);
  ASSERT_TRUE(scene.ground);
  EXPECT_EQ(scene.ground->height_m, 0.5);
  EXPECT_EQ(scene.materials, (std::vector<std::string>{"soil", "leaf"}));
  ASSERT_EQ(scene.prototypes.size(), 1u);
  ASSERT_EQ(scene.prototypes[0].discs.size(), 2u);
  EXPECT_EQ(scene.prototypes[0].discs[0].normal, Eigen::Vector3f(0, 0, 1));
  EXPECT_EQ(scene.prototypes[0].disc_material, 1u);
  ASSERT_EQ(scene.instances.size(), 4u);
  EXPECT_NEAR(turned_about_z(scene.instances[1]), pi / 2, 1e-6);
  EXPECT_EQ(scene.instances[1].scale, 1);
  EXPECT_NEAR(turned_about_z(scene.instances[3]), pi, 1e-6);
  EXPECT_EQ(scene.instances[3].scale, 2);
  EXPECT_EQ(scene.inputs.size(), 3u);
}

TEST_F(SceneFile, TakesPlantsAndMeshes) {
  const Scene scene = read(R"(
[domain]
boundary = "open"
[materials.green]
[materials.bark]
[prototypes.grass]
plant = "grass.bpms"
materials = { leaf = "green", stem = "bark" }
[prototypes.sheet]
mesh = "leaf.obj"
unit = "cm"
material = "green"
[[instances]]
prototype = "grass"
positions = [[0, 0, 0]]
[[instances]]
prototype = "sheet"
positions = [[1, 0, 0]]
)");
  ASSERT_EQ(scene.prototypes.size(), 2u);
  const Prototype& grass = scene.prototypes[0];
  ASSERT_EQ(grass.material_of_organ.size(), grass.mesh->organs.size());
  for (std::size_t k = 0; k < grass.mesh->organs.size(); ++k)
    EXPECT_EQ(scene.materials[grass.material_of_organ[k]],
              grass.mesh->organs[k].kind == "leaf" ? "green" : "bark");
  EXPECT_NEAR(scene.prototypes[1].mesh->organs[0].area_m2, 1e-4, 1e-9);
}

TEST_F(SceneFile, TakesStemsAsShapesOrTriangles) {
  const auto grass = [&](const std::string& more) {
    return read(
               "[domain]\nboundary = \"open\"\n[materials.leaf]\n[materials.stem]\n[prototypes.grass]\nplant "
               "= "
               "\"grass.bpms\"\n" +
               more + "\n[[instances]]\nprototype = \"grass\"\npositions = [[0, 0, 0]]\n")
        .prototypes[0];
  };
  EXPECT_EQ(grass("").shapes.size(), 1u);
  EXPECT_EQ(grass("solids = \"shapes\"").shapes.size(), 1u);
  const Prototype triangles = grass("solids = \"triangles\"");
  EXPECT_TRUE(triangles.shapes.empty());
  EXPECT_GT(triangles.mesh->triangles.size(), grass("").mesh->triangles.size());
  EXPECT_THROW(grass("solids = \"boxes\""), Error);
}

// Leaves that were written as Bezier patches come back, to the digits written.
TEST_F(SceneFile, ReadsThePatchesOfLeavesBack) {
  const Plant plant =
      read_plant(folder.write("leaf.bpms",
                              "units cm\nl\nl { a_length 20 a_width 2 "
                              "f_inclination n 0 20 1 60 section v_fold f_curvature n 0 20 1 5 }\n"));
  const std::vector<BezierPatch> patches = plant_patches(plant, 1e-4);
  const std::vector<BezierPatch> back = parse_patches("leaf.bpt", patch_file_text(patches));
  ASSERT_EQ(back.size(), patches.size());
  EXPECT_GE(patches.size(), 2u);
  for (std::size_t k = 0; k < patches.size(); ++k)
    for (std::size_t i = 0; i < 16; ++i) EXPECT_LT((back[k][i] - patches[k][i]).norm(), 1e-10);
}

TEST_F(SceneFile, NamesWhatIsWrongAndWhere) {
  struct Case {
    const char* piece;
    const char* other;
    const char* message;
  };
  const Case cases[] = {
      {"size_m = [10.0, 8.0]", "size_m = [10.0]", "scene.toml:2"},
      {"size_m = [10.0, 8.0]", "size_m = [10.0, -8]", "above 0"},
      {"size_m = [10.0, 8.0]\n", "", "needs its size"},
      {"\"periodic\"", "\"periodical\"", "did you mean 'periodic'"},
      {"\"east_counterclockwise\"", "\"north\"", "scene.toml:4"},
      {"type = \"plane\"", "type = \"dem\"", "missing key 'file'"},
      {"material = \"soil\"", "material = \"soul\"", "did you mean 'soil'"},
      {"material = \"soil\"", "colour = 3", "missing key 'material'"},
      {"material = \"leaf\"", "material = \"lead\"",
       "scene.toml:15:12: there is no [materials.lead]; did you mean 'leaf'?"},
      {"material = \"leaf\"", "", "needs material"},
      {"material = \"leaf\"", "materials = { leaf = \"leaf\" }", "discs have one material"},
      {"discs = \"crown.def\"", "librat = \"x.obj\"", "not built yet"},
      {"discs = \"crown.def\"", "", "needs one of discs, plant, mesh, shapes, patches, parts"},
      {"discs = \"crown.def\"", "discs = \"crown.def\"\nmesh = \"leaf.obj\"", "needs one of"},
      {"prototype = \"crown\"", "prototype = \"clown\"", "did you mean 'crown'"},
      {"[[1, 2, 3], [1, 2, 4, 180]]", "[[1, 2]]", "expected [x, y, z]"},
      {"[[1, 2, 3], [1, 2, 4, 180]]", "[]", "no positions"},
      {"[[1, 2, 3], [1, 2, 4, 180]]", "[[1e9, 2, 3]]", "1e7"},
      {"scale = 2", "scale = 0", "above 0"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.other);
    BPMS_EXPECT_ERROR(read_with(c.piece, c.other), ErrorKind::bad_input, c.message);
  }
  BPMS_EXPECT_ERROR(read_with("crown.def", "cream.def"), ErrorKind::missing_resource,
                    "cream.def: no such file");
}

TEST_F(SceneFile, NotesPrototypesThatStandNowhere) {
  const Scene scene = read(good + "[prototypes.other]\ndiscs = \"crown.def\"\nmaterial = \"leaf\"\n");
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_THAT(scene.notes[0], ::testing::HasSubstr("[prototypes.other] stands nowhere"));
}

TEST_F(SceneFile, RefusesBadDiscLists) {
  struct Case {
    const char* text;
    const char* message;
  };
  const Case cases[] = {
      {"0.1 0 0 1 0 0 1\n0 0 0 1 0 0 1\n", "discs.def:2:1: radius 0"},
      {"-1 0 0 1 0 0 1\n", "radius -1"},
      {"0.1 0 0 1 0 0 0\n", "the normal is (0, 0, 0)"},
      {"0.1 0 0 1 0 0\n", "discs.def:1: 6 columns, expected 7"},
      {"0.1 0 0 1 0 0 1 7\n", "more than 7 columns"},
      {"0.1 0 zero 1 0 0 1\n", "discs.def:1:7: found 'zero', expected y"},
      {"0.1 0 0 nan 0 0 1\n", "expected z"},
      {"0.1 0 1e20 1 0 0 1\n", "expected y"},
      {"# nothing\n", "no rows"},
      {"", "empty"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    BPMS_EXPECT_ERROR(read_disc_list(folder.write("discs.def", c.text)), ErrorKind::bad_input, c.message);
  }
}

TEST_F(SceneFile, RefusesBadMeshes) {
  BPMS_EXPECT_ERROR(read_mesh_file(folder / "none.obj"), ErrorKind::missing_resource, "no such file");
  BPMS_EXPECT_ERROR(read_mesh_file(folder.write("bad.ply", "this is no mesh")), ErrorKind::bad_input,
                    "bad.ply");
  BPMS_EXPECT_ERROR(read_mesh_file(folder.write("points.obj", "v 0 0 0\nv 1 0 0\n")), ErrorKind::bad_input,
                    "points.obj");
}

TEST(Azimuth, FollowsTheConvention) {
  Domain domain;
  const double quarter = pi / 2;
  EXPECT_TRUE(direction_from_angles(quarter, 0, domain).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE(direction_from_angles(quarter, quarter, domain).isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  domain.azimuth_north_clockwise = false;
  EXPECT_TRUE(direction_from_angles(quarter, 0, domain).isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  EXPECT_TRUE(direction_from_angles(quarter, quarter, domain).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE(direction_from_angles(0, 1, domain).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(Het01, IsReadAndTraced) {
  BPMS_NEED_DATA("rami/het01/het01_UNI_sphere.def");
  const std::string folder = test::data_folder() + "/rami/het01/";
  const test::SceneText text{.domain = "size_m = [100, 100]",
                             .leaf = test::bilambertian("0.4957", "0.4409"),
                             .soil = test::lambertian("0.159"),
                             .discs = folder + "het01_UNI_sphere.def",
                             .positions = "\"" + folder + "het01_UNI_instances.def\""};
  const Scene scene = read_scene_geometry(TomlDocument::parse("het01.toml", text.str()));
  EXPECT_EQ(scene.prototypes[0].discs.size(), 49999u);
  EXPECT_EQ(scene.instances.size(), 15u);
  const Intersector intersector(scene);
  RecordProperty("embree_mib", static_cast<int>(intersector.memory_bytes() >> 20));
  Hit hit;
  ASSERT_EQ(intersector.intersect({{-24.8302f, 11.6110f, 60}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
  EXPECT_LT(intersector.top_m(), 28);
}

}  // namespace
}  // namespace bpms
