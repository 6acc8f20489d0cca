#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/units.h"
#include "scene/importers/shape_list.h"
#include "scene/intersect/intersector.h"
#include "scene/structure/structure.h"
#include "tests/data.h"

namespace bpms {
namespace {

std::vector<Shape> parse(const std::string& text, const std::string& material = "bark") {
  Scene scene;
  MaterialNames names(scene);
  return parse_shape_list("shapes.txt", text, material, {"scene.toml", 7, 1}, names);
}

TEST(ShapeFile, TakesEachKind) {
  const std::vector<Shape> shapes = parse(
      "# stems\n"
      "sphere 1 2 3 0.5\n"
      "ellipsoid 0 0 0 1 2 3 leaf\n"
      "ellipsoid 0 0 0 1 2 3 90 0 90\n"
      "spheroid 0 0 0 0.1 2 0 1 0 leaf\n"
      "cylinder 0 0 0 0 0 2 0.1\n"
      "cylinder 0 0 0 3 0 0 0.1 open leaf\n"
      "cone 0 0 0 0 0 1 0.2 0 closed\n");
  ASSERT_EQ(shapes.size(), 7u);
  EXPECT_EQ(shapes[0].centre_m, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(shapes[0].material, 0u);  // bark, the first that is used
  EXPECT_EQ(shapes[1].material, 1u);
  // x first: the longest axis, z, goes to -y, and by z on to +x.
  EXPECT_NEAR(shape_support(shapes[2], {1, 0, 0}).x(), 3, 1e-6);
  EXPECT_NEAR(shape_support(shapes[2], {0, 1, 0}).y(), 1, 1e-6);
  EXPECT_NEAR(shape_support(shapes[2], {0, 0, 1}).z(), 2, 1e-6);
  EXPECT_NEAR(shape_support(shapes[3], {0, 1, 0}).y(), 2, 1e-6);
  EXPECT_NEAR(shape_support(shapes[3], {1, 0, 0}).x(), 0.1, 1e-6);
  EXPECT_TRUE(shapes[4].closed);
  EXPECT_FALSE(shapes[5].closed);
  EXPECT_EQ(shapes[5].material, 1u);
  EXPECT_NEAR(shape_support(shapes[5], {1, 0, 0}).x(), 3, 1e-6);
  EXPECT_NEAR(shape_area_m2(shapes[6]), pi * 0.2 * std::hypot(1, 0.2) + pi * 0.04, 1e-6);
}

TEST(ShapeFile, NamesWhatIsWrongAndWhere) {
  struct Case {
    const char* text;
    const char* message;
  };
  const Case cases[] = {
      {"sphere 0 0 0 1\nspere 0 0 0 1\n", "shapes.txt:2:1: there is no shape 'spere'; did you mean 'sphere'"},
      {"sphere 0 0 0\n", "the line ends early, expected x y z r"},
      {"sphere 0 0 0 0\n", "shapes.txt:1:14: found '0', expected a length above 0"},
      {"sphere 0 0 0 -1\n", "found '-1', expected a length above 0"},
      {"sphere 0 0 nan 1\n", "shapes.txt:1:12: found 'nan', expected a number"},
      {"sphere 0 0 1e9 1\n", "beyond 1e7"},
      {"sphere 0 0 0 1 2\n", "shapes.txt:1:16: too many numbers"},
      {"sphere 0 0 0 1 bark leaf\n", "shapes.txt:1:21: found more behind the material"},
      {"cylinder 1 1 1 1 1 1 0.1\n", "shapes.txt:1:10: the two ends are the same point"},
      {"cone 0 0 0 0 0 1 0 0\n", "shapes.txt:1:18: both radii are 0"},
      {"cone 0 0 0 0 0 1 0.1 -0.1\n", "no length below 0"},
      {"cylinder 0 0 0 0 0 1 0.1 open closed x\n", "found more"},
      {"spheroid 0 0 0 1 2 0 0 0\n", "shapes.txt:1:20: the axis is (0, 0, 0)"},
      {"ellipsoid 0 0 0 1 1 1 90\n", "ends early"},
      {"# nothing\n", "no lines"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    BPMS_EXPECT_ERROR(parse(c.text), ErrorKind::bad_input, c.message);
  }
  BPMS_EXPECT_ERROR(parse("sphere 0 0 0 1\n", ""), ErrorKind::bad_input, "shapes.txt:1:1: no material");
}

class ShapeScene : public ::testing::Test {
 protected:
  Scene read(const std::string& shapes, const std::string& keys) {
    folder.write("stems.txt", shapes);
    return read_scene_geometry(
        TomlDocument::read(folder.write("scene.toml",
                                        "[domain]\nboundary = \"open\"\n[materials.bark]\n"
                                        "[materials.fruit]\n[prototypes.stem]\nshapes = \"stems.txt\"\n" +
                                            keys +
                                            "[[instances]]\nprototype = \"stem\"\n"
                                            "positions = [[0, 0, 0], [10, 0, 0]]\nscale = 2\n")));
  }
  test::TemporaryFolder folder;
};

TEST_F(ShapeScene, CountsSurfacesThatAreNoLeaves) {
  const Scene scene = read("cylinder 0 0 0 0 0 1 0.1\nsphere 0 0 1.5 0.2 fruit\n", "material = \"bark\"\n");
  const CanopyStructure structure = canopy_structure(scene, {.gaps = {.rays = 1u << 10}});
  const double stem = 2 * 4 * (2 * pi * 0.1 * 1 + 2 * pi * 0.01), fruit = 2 * 4 * 4 * pi * 0.04;
  EXPECT_NEAR(structure.surface.materials.at("bark").other_m2, stem, 1e-5);
  EXPECT_NEAR(structure.surface.materials.at("fruit").other_m2, fruit, 1e-5);
  EXPECT_EQ(structure.lai, 0);
  EXPECT_NEAR(structure.height_m, 3.4, 1e-6);
  // The plan view's hull: two circles of 0.4 m, 10 m apart; of 24 points each, 1.2 % less in their halves.
  EXPECT_NEAR(structure.ground_area_m2, 8 + pi * 0.16, 0.015);
  // From below, circles and stems hide what they cover: the fruits' shadows.
  EXPECT_NEAR(structure.gaps[0].plant.p, 1 - 2 * pi * 0.16 / structure.ground_area_m2,
              5 * structure.gaps[0].plant.standard_error + 1e-3);
}

TEST_F(ShapeScene, NeedsMaterialsThatAreThere) {
  BPMS_EXPECT_ERROR(read("sphere 0 0 0 1 bork\n", ""), ErrorKind::bad_input,
                    "stems.txt:1:16: there is no [materials.bork]; did you mean 'bark'?");
  BPMS_EXPECT_ERROR(read("sphere 0 0 0 1\n", "material = \"bork\"\n"), ErrorKind::bad_input,
                    "scene.toml:7:12: there is no [materials.bork]");
}

TEST_F(ShapeScene, KnowsItsInside) {
  const Intersector intersector(read("cylinder 0 0 0 0 0 1 0.1\n", "material = \"bark\"\n"));
  EXPECT_TRUE(intersector.inside_solid({10.1, 0.1, 1.9}));
  EXPECT_FALSE(intersector.inside_solid({10.1, 0.2, 1.9}));
  EXPECT_FALSE(intersector.inside_solid({10, 0, -0.1}));
}

}  // namespace
}  // namespace bpms
