// Terrain: what is read, where rays meet it against the heights themselves, cells that repeat, and what is
// refused.
#include "plant/terrain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "plant/terrain/terrain_file.h"
#include "scene/intersect/intersector.h"
#include "scene/intersect/parallel_rays.h"
#include "scene/structure/structure.h"
#include "tests/data.h"
#include "tests/scene/shapes.h"

namespace bpms {
namespace {

constexpr IntersectorOptions flat{}, instanced{1000, 0};

// Hills that repeat every 8 x 6 m.
double hill(double x, double y) {
  return 0.5 * std::sin(2 * pi * x / 8) + 0.3 * std::cos(2 * pi * y / 6) +
         0.2 * std::sin(2 * pi * (x / 4 + y / 3));
}

std::string grid(int columns, int rows, double spacing, double west, double south) {
  std::string out =
      fmt::format("ncols {}\nnrows {}\nxllcenter {}\nyllcenter {}\ncellsize {}\nNODATA_value -9999\n",
                  columns, rows, west, south, spacing);
  for (int j = rows - 1; j >= 0; --j) {
    for (int i = 0; i < columns; ++i)
      out += fmt::format("{:.9f} ", hill(west + i * spacing, south + j * spacing));
    out += "\n";
  }
  return out;
}

class TerrainScene : public ::testing::Test {
 protected:
  Scene read(const std::string& file, const std::string& keys, const std::string& domain) {
    folder.write("hills.asc", file);
    return read_scene_geometry(TomlDocument::read(
        folder.write("scene.toml", "[domain]\n" + domain +
                                       "\n[materials.soil]\n[ground]\ntype = \"dem\"\nfile = \"hills.asc\"\n"
                                       "material = \"soil\"\n" +
                                       keys)));
  }
  Scene periodic(const std::string& keys = "") {
    return read(grid(33, 25, 0.25, -4, -3), keys, "size_m = [8, 6]");
  }
  test::TemporaryFolder folder;
};

TEST_F(TerrainScene, IsMetWhereItsTrianglesAre) {
  const Scene scene = periodic();
  const Terrain& terrain = *scene.ground->terrain;
  EXPECT_EQ(terrain.size_m(), Eigen::Vector2d(8, 6));
  for (const IntersectorOptions& options : {flat, instanced}) {
    const Intersector intersector(scene, options);
    EXPECT_NEAR(intersector.top_m(), *std::max_element(terrain.heights_m.begin(), terrain.heights_m.end()),
                1e-6);
    Philox random(1);
    for (int k = 0; k < 3000; ++k) {
      const Eigen::Vector3d at(random.uniform(-4, 4), random.uniform(-3, 3), 5);
      Hit hit;
      ASSERT_EQ(intersector.intersect({at.cast<float>(), {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
      ASSERT_TRUE(hit.ground);
      EXPECT_TRUE(hit.front);
      EXPECT_EQ(hit.material, 0u);
      EXPECT_EQ(intersector.plant_of(hit.id), no_plant);
      const Eigen::Vector2d p = hit.position.head<2>().cast<double>();
      EXPECT_NEAR(hit.position.z(), terrain.height_m(p), 2e-6);
      // Off by at most step^2 / 8 (|z_xx| + 2 |z_xy| + |z_yy|) = 0.25^2 / 8 (0.80 + 1.32 + 1.21).
      EXPECT_NEAR(hit.position.z(), hill(p.x(), p.y()), 0.0261);
      EXPECT_GT(hit.shading_normal.z(), 0.5f);
      EXPECT_NEAR(hit.uv.x(), (p.x() + 4) / 8, 1e-6);
      EXPECT_NEAR(hit.uv.y(), (p.y() + 3) / 6, 1e-6);
      EXPECT_NEAR(hit.dp_du.x(), 8, 1e-4);
      EXPECT_NEAR(hit.dp_dv.y(), 6, 1e-4);
      EXPECT_TRUE(intersector.inside_solid(hit.position.cast<double>() - Eigen::Vector3d(0, 0, 1e-3)));
      EXPECT_FALSE(intersector.inside_solid(hit.position.cast<double>() + Eigen::Vector3d(0, 0, 1e-3)));
      // Straight up from there is sky.
      EXPECT_EQ(intersector.intersect({hit.position, {0, 0, 1}, 1e30f, hit.id}, hit), Escape::top);
    }
  }
}

TEST_F(TerrainScene, HasNormalsOfTheSlope) {
  const Scene scene = read(grid(129, 97, 0.0625, -4, -3), "", "size_m = [8, 6]");
  const Intersector intersector(scene);
  Philox random(2);
  for (int k = 0; k < 1000; ++k) {
    const double x = random.uniform(-4, 4), y = random.uniform(-3, 3), h = 1e-5;
    Hit hit;
    ASSERT_EQ(intersector.intersect({Eigen::Vector3d(x, y, 5).cast<float>(), {0, 0, -1}, 1e30f, {}}, hit),
              Escape::hit);
    const Eigen::Vector3d n((hill(x - h, y) - hill(x + h, y)) / (2 * h),
                            (hill(x, y - h) - hill(x, y + h)) / (2 * h), 1);
    // Central differences over 0.125 m and waves of 2.4 m: 1 % of the slope, at the edges as well.
    EXPECT_LT((hit.shading_normal.cast<double>() - n.normalized()).norm(), 0.02) << x << " " << y;
  }
}

TEST_F(TerrainScene, RepeatsLikeALargeTiling) {
  Scene cell = periodic();
  Scene tiles =
      read(grid(33 + 32 * 10, 25 + 24 * 10, 0.25, -4 - 8 * 5, -3 - 6 * 5), "", "boundary = \"open\"");
  const Intersector one(cell), all(tiles);
  Philox random(3);
  int hits = 0, different = 0;
  constexpr int rays = 10'000;
  for (int k = 0; k < rays; ++k) {
    const double azimuth = random.uniform(0, 2 * pi), sine = random.uniform(0.1, 1);
    const double level = std::sqrt(1 - sine * sine);
    const Eigen::Vector3d d(level * std::cos(azimuth), level * std::sin(azimuth), -sine);
    const Eigen::Vector3d o(random.uniform(-4, 4), random.uniform(-3, 3), 1.2);
    const Ray ray{o.cast<float>(), d.cast<float>(), 1e30f, {}};
    Hit a, b;
    ASSERT_EQ(one.intersect(ray, a), Escape::hit);
    ASSERT_EQ(all.intersect(ray, b), Escape::hit);
    if (std::abs(a.distance - b.distance) > 1e-3) {
      ++different;
      continue;
    }
    ++hits;
    EXPECT_LT((a.geometric_normal - b.geometric_normal).norm(), 2e-2);
  }
  EXPECT_LT(different, rays / 500);  // at crests
}

TEST_F(TerrainScene, InAnOpenSceneHasAPlaneOutsideOrNothing) {
  const std::string hills = grid(33, 25, 0.25, -4, -3);
  const Intersector bare(read(hills, "", "boundary = \"open\""));
  const Intersector island(read(hills, "outside_height_m = 0.25\n", "boundary = \"open\""));
  Hit hit;
  const Ray outside{{7, 1, 9}, {0, 0, -1}, 1e30f, {}}, inside{{-2, 1, 9}, {0, 0, -1}, 1e30f, {}};
  EXPECT_EQ(bare.intersect(outside, hit), Escape::bottom);
  ASSERT_EQ(island.intersect(outside, hit), Escape::hit);
  EXPECT_TRUE(hit.ground);
  EXPECT_EQ(hit.position.z(), 0.25f);
  ASSERT_EQ(island.intersect(inside, hit), Escape::hit);
  EXPECT_LT(hit.position.z(), 0.2f);  // below the plane, which is not there
  EXPECT_TRUE(hit.ground);
  EXPECT_FALSE(island.inside_solid({-2, 1, 0.2}));
  EXPECT_TRUE(island.inside_solid({7, 1, 0.2}));
  EXPECT_FALSE(bare.inside_solid({7, 1, 0.2}));
}

TEST_F(TerrainScene, IsPutWhereItIsAskedFor) {
  const std::string far_away = grid(5, 5, 1, 500'000, 4'000'000);
  const Scene scene = read(far_away, "centred = true\noffset_m = [1, 0, 100]\n", "boundary = \"open\"");
  EXPECT_EQ(scene.ground->terrain->low_m, Eigen::Vector2d(-1, -2));
  EXPECT_NEAR(scene.ground->terrain->heights_m[0], 100 + hill(500'000, 4'000'000), 1e-5);
  // The corner of the south-western cell lies half a step from its centre.
  const Terrain corner =
      parse_terrain("x.asc", "NCOLS 2\nNROWS 3\nXLLCORNER 10\nYLLCORNER 20\nCELLSIZE 2\n1 2\n3 4\n5 6\n");
  EXPECT_EQ(corner.low_m, Eigen::Vector2d(11, 21));
  EXPECT_EQ(corner.heights_m, (std::vector<float>{5, 6, 3, 4, 1, 2}));
}

TEST_F(TerrainScene, RefusesWhatDoesNotFitTheDomain) {
  BPMS_EXPECT_ERROR(
      read(grid(33, 25, 0.25, -4, -3), "", "size_m = [8, 8]"), ErrorKind::bad_input,
      "scene.toml:6:8: ground.file: the terrain is 8 x 6 m (33 x 25 nodes, 0.25 m apart), expected the "
      "size of the periodic domain, 8 x 8 m");
  BPMS_EXPECT_ERROR(read(grid(33, 25, 0.25, 0, 0), "", "size_m = [8, 6]"), ErrorKind::bad_input,
                    "middle is at (4, 3), expected the origin");
  BPMS_EXPECT_ERROR(read(grid(17, 25, 0.25, -2, -3), "", "size_m = [4, 6]"), ErrorKind::bad_input,
                    "opposite edges of the terrain differ by up to 1 m");
  BPMS_EXPECT_ERROR(read(grid(5, 5, 1, 5e7, 0), "", "boundary = \"open\""), ErrorKind::bad_input,
                    "beyond 1e7 m");
  BPMS_EXPECT_ERROR(periodic("outside_height_m = 0\n"), ErrorKind::bad_input, "has no outside");
  EXPECT_EQ(Intersector(periodic()).parallel_rays(periodic(), {0, 0, 1}), nullptr);
}

TEST(TerrainFile, NamesWhatIsWrongAndWhere) {
  const std::string head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  struct Case {
    std::string text;
    const char* message;
  };
  const Case cases[] = {
      {head + "NODATA_value -9999\n1 2\n3 -9999\n", "x.asc:8:3: no data (NODATA_value) in row 2, column 2"},
      {head + "1 2\n3\n", "the grid ends after 3 heights, expected 2 rows of 2"},
      {head + "1 2\n3 4 5\n", "x.asc:7:5: more heights"},
      {head + "1 2\n3 nan\n", "x.asc:7:3"},
      {"ncols 2\nnrow 2\n",
       "x.asc:2:1: found 'nrow', expected a key of an ESRI ASCII grid or a height; did you mean"},
      {"ncols 2\nncols 2\n", "given twice"},
      {"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\n1 2 3 4\n", "no cellsize"},
      {"ncols 1\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n",
       "x.asc:1:1: ncols 1, expected a whole number"},
      {"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0\n1 2 3 4\n", "cellsize 0, expected"},
      {"ncols 99999\nnrows 99999\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n", "the file holds fewer"},
      {head + "xllcenter 1\n1 2\n3 4\n", "both xllcorner and xllcenter"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    BPMS_EXPECT_ERROR(parse_terrain("x.asc", c.text), ErrorKind::bad_input, c.message);
  }
}

TEST_F(TerrainScene, IsWhereGapsAreLookedForFrom) {
  // A roof above the hills that covers a quarter of the cell: the gap fraction at the zenith is 3/4, no ray
  // is lost in the terrain itself.
  Scene scene = periodic();
  scene.materials.push_back("leaf");
  auto roof = std::make_shared<Mesh>();
  roof->positions_m = {{-4, -3, 3}, {0, -3, 3}, {0, 0, 3}, {-4, 0, 3}};
  roof->triangles = {{0, 1, 2}, {0, 2, 3}};
  roof->organ_of_triangle = {0, 0};
  roof->organs.push_back({0, "roof", "leaf", "leaf", 0, 12});
  scene.prototypes = {test::mesh_prototype(roof)};
  scene.prototypes[0].material_of_organ = {1};
  scene.instances.emplace_back();
  const CanopyStructure structure = canopy_structure(scene, {.gaps = {.rays = 1u << 13}});
  EXPECT_NEAR(structure.gaps[0].plant.p, 0.75, 5 * structure.gaps[0].plant.standard_error + 1e-4);
  EXPECT_NEAR(structure.lai, 0.25, 1e-9);
}

}  // namespace
}  // namespace bpms
