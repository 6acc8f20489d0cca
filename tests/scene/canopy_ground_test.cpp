// Canopies with terrain in scenes: the ground that comes with them, plants that lean, what must agree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/units.h"
#include "scene/importers/plants.h"
#include "scene/intersect/intersector.h"
#include "tests/data.h"

namespace bpms {
namespace {

class CanopyOnGround : public ::testing::Test {
 protected:
  void SetUp() override {
    folder.write("a.bpms", "units cm s s { material stem a_length 10 a_radius 0.1 }");
    std::string slope = "ncols 5\nnrows 5\nxllcenter -2\nyllcenter -2\ncellsize 1\n";
    for (int j = 2; j >= -2; --j)
      for (int i = -2; i <= 2; ++i) slope += fmt::format("{} ", 0.75 * i);
    folder.write("slope.asc", slope);
  }
  void canopy(const std::string& domain, const std::string& more) {
    folder.write("canopy.toml",
                 "[domain]\nsize_m = [2, 2]\n" + domain +
                     "[[plants]]\nfile = \"a.bpms\"\nrotation = { type = \"fixed\", deg = 30 }\n"
                     "[planting]\npattern = \"regular\"\nspacing_m = 0.5\n" +
                     more);
  }
  Scene scene(const std::string& text) {
    return read_scene_geometry(TomlDocument::read(folder.write(
        "scene.toml",
        "canopy = \"canopy.toml\"\n[materials.soil]\n[materials.stem]\n[materials.mud]\n" + text)));
  }
  const std::string slope_ = "tilt = \"normal\"\n[terrain]\nfile = \"slope.asc\"\nmaterial = \"soil\"\n";
  const std::string ridges_ =
      "[terrain]\nmaterial = \"soil\"\n[ridges]\nspacing_m = 0.5\nheight_m = 0.1\nshape = \"triangle\"\n";
  test::TemporaryFolder folder;
};

TEST_F(CanopyOnGround, BringsItsGround) {
  canopy("boundary = \"open\"\n", slope_);
  for (const Scene& made : {scene(""), canopy_scene(folder / "canopy.toml")}) {
    ASSERT_TRUE(made.ground && made.ground->terrain);
    EXPECT_EQ(made.materials[made.ground->material], "soil");
    EXPECT_FALSE(made.ground->has_plane());
    const Intersector intersector(made);
    Hit hit;
    ASSERT_EQ(intersector.intersect({{0.9f, 0.2f, 5}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
    EXPECT_TRUE(hit.ground);
    EXPECT_NEAR(hit.position.z(), 0.75 * 0.9, 1e-6);
    // A stem stands along the normal (-0.6, 0, 0.8): a ray across it, 5 cm up, meets it.
    const Eigen::Vector3f base(0.25f, 0.25f, 0.1875f), up(-0.6f, 0, 0.8f);
    const Eigen::Vector3f start = base + 0.05f * up - Eigen::Vector3f(0, 0.1f, 0);
    ASSERT_EQ(intersector.intersect({start, {0, 1, 0}, 0.2f, {}}, hit), Escape::hit);
    EXPECT_FALSE(hit.ground);
    EXPECT_NEAR(hit.distance, 0.099, 1e-4);  // the stem's radius is a millimetre
  }
}

TEST_F(CanopyOnGround, TheScenesOwnGroundMustBeTheSame) {
  canopy("boundary = \"open\"\n", slope_);
  const std::string same = "[ground]\ntype = \"dem\"\nfile = \"slope.asc\"\nmaterial = \"soil\"\n";
  EXPECT_TRUE(scene(same).ground->terrain);
  using enum ErrorKind;
  BPMS_EXPECT_ERROR(
      scene("[ground]\ntype = \"plane\"\nmaterial = \"soil\"\n"), bad_input,
      "scene.toml:5:1: ground: the canopy brings its own terrain and this is a plane: leave [ground] out");
  BPMS_EXPECT_ERROR(scene(same + "offset_m = [0, 0, 1]\n"), bad_input, "this terrain differs from it");
  BPMS_EXPECT_ERROR(scene(same + "outside_height_m = 0\n"), bad_input, "outside_height_m differs");
  BPMS_EXPECT_ERROR(scene("[ground]\ntype = \"dem\"\nfile = \"slope.asc\"\nmaterial = \"mud\"\n"), bad_input,
                    "another material");
  BPMS_EXPECT_ERROR(
      scene("[domain]\nsize_m = [4, 4]\nboundary = \"periodic\"\n"), bad_input,
      "scene.toml:5:1: domain: the canopy has terrain, made for its own open domain of 2 x 2 m");
  canopy("boundary = \"open\"\n", "[terrain]\nfile = \"slope.asc\"\nmaterial = \"siol\"\n");
  BPMS_EXPECT_ERROR(scene(""), bad_input, "there is no [materials.siol]; did you mean 'soil'?");
}

TEST_F(CanopyOnGround, RidgesRepeatWithoutAStep) {
  canopy("", ridges_);
  const Scene made = scene("");
  EXPECT_TRUE(made.domain.periodic);
  const Intersector intersector(made);
  for (int k = 0; k < 40; ++k) {
    const float x = -1 + 0.05f * static_cast<float>(k) + 0.003f;
    Hit hit;
    ASSERT_EQ(intersector.intersect({{x, 0.9f, 5}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
    const double from_top = std::abs(std::remainder(static_cast<double>(x) - 0.25, 0.5));
    ASSERT_TRUE(hit.ground);
    EXPECT_NEAR(hit.position.z(), 0.1 * (1 - from_top / 0.25), 1e-6);
  }
  BPMS_EXPECT_ERROR(scene("[domain]\nsize_m = [4, 4]\n"), ErrorKind::bad_input, "periodic domain of 2 x 2 m");
}

}  // namespace
}  // namespace bpms
