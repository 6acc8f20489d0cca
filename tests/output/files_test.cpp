// ENVI cubes and files of the RAMI On-line Model Checker, read back.
#include <gmock/gmock.h>

#include <cstring>
#include <set>
#include <sstream>

#include "core/units.h"
#include "simulate/output/envi.h"
#include "simulate/output/output.h"
#include "simulate/output/romc_files.h"
#include "tests/output/said_by.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

using ::testing::HasSubstr;

float pixel_of(const EnviCube& cube, std::size_t index) {
  float out = 0;
  std::memcpy(&out, cube.pixels.data() + 4 * index, 4);
  return out;
}

std::string value_of(const std::string& header, const std::string& key) {
  const std::size_t at = header.find("\n" + key + " = ");
  if (at == std::string::npos) return {};
  const std::size_t from = at + key.size() + 4;
  return header.substr(from, header.find('\n', from) - from);
}

SceneText fisheye() {
  return {.soil = lambertian("[[400, 0.1], [900, 0.3]]"),
          .sun = sun_at(40, 120),
          .sensor =
              "name = \"round\"\ntype = \"spherical\"\nlocation = [0, 0, 1]\nlooking = \"out\"\n"
              "direction = [0, 0, -1]\nup = [0, 1, 0]\nwidth_px = 6\nheight_px = 6\n",
          .wavelengths_nm = "[650, 850]",
          .sampling = "samples = 32"};
}

TEST(Envi, AnImageIsBandSequentialWithItsCornersMarked) {
  const TemporaryFolder folder;
  const Simulation simulation = simulation_of(folder, fisheye());
  const Result result = simulate(simulation, 1);
  const EnviCube cube = envi_cube(simulation, result.sensors[0], false, "test");
  ASSERT_EQ(cube.pixels.size(), 6u * 6 * 2 * 4);
  EXPECT_EQ(value_of(cube.header, "samples"), "6");
  EXPECT_EQ(value_of(cube.header, "lines"), "6");
  EXPECT_EQ(value_of(cube.header, "bands"), "2");
  EXPECT_EQ(value_of(cube.header, "interleave"), "bsq");
  EXPECT_EQ(value_of(cube.header, "wavelength"), "{650, 850}");
  EXPECT_EQ(pixel_of(cube, 0), envi_no_value);
  // Bare soil under irradiance "brf": radiance is the reflectance, 0.2 and 0.28.
  EXPECT_NEAR(pixel_of(cube, 6 * 3 + 3), 0.2f, 1e-6);
  EXPECT_NEAR(pixel_of(cube, 36 + 6 * 3 + 3), 0.28f, 1e-6);
}

TEST(Envi, ViewsAreOneLineAndBandsKeepTheirAngles) {
  const TemporaryFolder folder;
  SceneText text = fisheye();
  text.sensor = principal_plane("[-30, 0, 30]");
  const Simulation simulation = simulation_of(folder, text);
  const EnviCube cube = envi_cube(simulation, simulate(simulation, 1).sensors[0], false, "a {b}, c");
  EXPECT_EQ(value_of(cube.header, "samples"), "3");
  EXPECT_EQ(value_of(cube.header, "lines"), "1");
  EXPECT_EQ(value_of(cube.header, "view zenith deg"), "{-30, 0, 30}");
  EXPECT_THAT(value_of(cube.header, "description"), HasSubstr("a  b   c}"));
}

TEST(Envi, OpensInGdal) {
  if (said_by("/usr/bin/python3 -c 'from osgeo import gdal; print(1)'") != "1\n") {
    if (data_required()) FAIL() << "python3-gdal is absent";
    GTEST_SKIP() << "needs python3-gdal";
  }
  const TemporaryFolder folder;
  const Simulation simulation = simulation_of(folder, fisheye());
  const EnviCube cube = envi_cube(simulation, simulate(simulation, 1).sensors[0], false, "test");
  folder.write("cube.img", cube.pixels);
  folder.write("cube.hdr", cube.header);
  EXPECT_EQ(
      said_by(
          "/usr/bin/python3 -W ignore -c 'from osgeo import gdal; gdal.UseExceptions(); d = gdal.Open(\"" +
          (folder / "cube.img") +
          "\"); b = d.GetRasterBand(2); print(d.RasterXSize, d.RasterYSize, d.RasterCount, "
          "d.GetDriver().ShortName, b.GetNoDataValue(), round(float(b.ReadAsArray()[3, 3]), 5), "
          "b.GetMetadataItem(\"wavelength\"), d.GetMetadata(\"ENVI\")[\"interleave\"])'"),
      "6 6 2 ENVI -9999.0 0.28 850 bsq\n");
}

TEST(Envi, NamesOfFilesDoNotClash) {
  const TemporaryFolder folder;
  SceneText text = fisheye();
  const std::string rest = text.sensor.substr(text.sensor.find('\n') + 1);
  text.sensor = "name = \"a b\"\n" + rest + "[[sensors]]\nname = \"a_b\"\n" + rest +
                "[[sensors]]\nname = \"a_b_2\"\n" + rest;
  const Simulation simulation = simulation_of(folder, text);
  std::set<std::string> names;
  for (std::size_t i = 0; i < 3; ++i) {
    names.insert(envi_path(simulation, i, "x/", false));
    names.insert(envi_path(simulation, i, "x/", true));
  }
  EXPECT_EQ(names.size(), 6u);
  EXPECT_EQ(envi_path(simulation, 0, "out", true), "out_a_b_se.img");
  EXPECT_EQ(envi_header_path("out_a_b.img"), "out_a_b.hdr");
}

struct RomcRow {
  double sza, vza, turn, brf, error;
};

std::vector<RomcRow> read_romc(const std::string& text) {
  std::istringstream in(text);
  std::size_t rows = 0, columns = 0;
  double ratio = 0;
  in >> rows >> columns >> ratio;
  EXPECT_EQ(columns, 5u);
  EXPECT_EQ(ratio, -1.0);
  std::vector<RomcRow> out(rows);
  for (RomcRow& row : out) in >> row.sza >> row.vza >> row.turn >> row.brf >> row.error;
  EXPECT_TRUE(static_cast<bool>(in));
  std::string rest;
  EXPECT_FALSE(static_cast<bool>(in >> rest)) << rest;
  return out;
}

TEST(Romc, FilesReadBack) {
  const TemporaryFolder folder;
  SceneText text = canopy_text(folder, {.lai = 1, .radius_m = 0.1, .size_m = {2, 2}, .top_m = 1});
  text.sun = sun_at(20, 350);
  text.sensor = principal_plane("[-75, 0, 75]") +
                "[[sensors]]\nname = \"cross\"\ntype = \"brf\"\nplane = \"cross\"\nvza_deg = [-30, 30]\n";
  text.sampling = "samples = 1024";
  const Simulation simulation = simulation_of(folder, text);
  const Result result = simulate(simulation, 1);
  const std::vector<RomcFile> files = romc_files(simulation, "out/TEST_20");
  ASSERT_EQ(files.size(), 8u);
  EXPECT_EQ(files[0].path, "out/brfpp_bpms-TEST_20.mes");
  EXPECT_EQ(files[2].path, "out/brfpp_co_sgl_bpms-TEST_20.mes");
  EXPECT_EQ(files[4].path, "out/brfop_bpms-TEST_20.mes");
  std::vector<std::vector<RomcRow>> read;
  for (const RomcFile& file : files) read.push_back(read_romc(romc_text(simulation, result, file)));
  constexpr double half_a_digit = 5.1e-7;  // of six decimals
  ASSERT_EQ(read[0].size(), 3u);
  EXPECT_NEAR(read[0][0].sza, radians(20), half_a_digit);
  EXPECT_NEAR(read[0][0].vza, radians(75), half_a_digit);
  EXPECT_NEAR(read[0][0].turn, 0, half_a_digit);  // -75: the sun's side
  EXPECT_NEAR(read[0][2].turn, pi, half_a_digit);
  EXPECT_NEAR(read[4][0].turn, pi / 2, half_a_digit);
  EXPECT_NEAR(read[4][1].turn, -pi / 2, half_a_digit);
  for (std::size_t view = 0; view < 3; ++view) {
    const Estimates& brf = result.sensors[0].radiance[0];  // irradiance "brf": radiance is the factor
    EXPECT_NEAR(read[0][view].brf, brf.value[view], half_a_digit);
    EXPECT_NEAR(read[0][view].error, brf.standard_error[view], half_a_digit);
    EXPECT_NEAR(read[1][view].brf + read[2][view].brf + read[3][view].brf, read[0][view].brf,
                4 * half_a_digit);
  }
}

TEST(Romc, NeedsOneSunAndAPlane) {
  const TemporaryFolder folder;
  SceneText text{.soil = lambertian("0.2"),
                 .sun = sun_at(20, 0),
                 .sensor = views("[[30, 45]]"),
                 .sampling = "samples = 32"};
  EXPECT_THROW(romc_files(simulation_of(folder, text), "X"), Error);
  text.sensor = principal_plane("[0, 30]");
  EXPECT_EQ(romc_files(simulation_of(folder, text), "X").size(), 4u);
  text.sky = white_sky;
  EXPECT_THROW(romc_files(simulation_of(folder, text), "X"), Error);
}

}  // namespace
}  // namespace bpms::test
