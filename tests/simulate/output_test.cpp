// Files as others read them.
#include <gmock/gmock.h>

#include <cstdio>

#include "core/csv.h"
#include "simulate/output/output.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

const SceneText three_views{.soil = lambertian("[[400, 0.1], [900, 0.3]]"),
                            .sun = sun_at(40, 120),
                            .sensor = principal_plane("[-30, 0, 30]"),
                            .wavelengths_nm = "[650, 850]",
                            .sampling = "samples = 64"};

std::string output_of(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::string out;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) out += static_cast<char>(c);
  pclose(pipe);
  return out;
}

TEST(Output, CsvHasTheColumnsOfTheContract) {
  const TemporaryFolder folder;
  const Simulation scene = simulation_of(folder, three_views);
  const Result result = simulate(scene, 1);
  const CsvTable table = CsvTable::parse("out.csv", result_csv(scene, result));
  const std::vector<std::string> expected{"quantity", "sensor",   "band",    "wavelength_nm", "sza_deg",
                                          "saa_deg",  "vza_deg",  "vaa_deg", "origin",        "component",
                                          "order",    "material", "value",   "standard_error"};
  EXPECT_EQ(table.columns(), expected);
  int totals = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, 0) != "brf" || table.text(row, 9) != "all" || !table.empty(row, 10)) continue;
    ++totals;
    EXPECT_EQ(table.text(row, 8), "total");
    EXPECT_NEAR(table.number(row, 12), table.number(row, 3) == 650 ? 0.2 : 0.28, 1e-6);
    EXPECT_EQ(table.number(row, 7), 300);
  }
  EXPECT_EQ(totals, 6);
}

// What a Python program says of out.nc, opened in xarray as d.
class NetcdfInXarray : public ::testing::Test {
 protected:
  void SetUp() override {
    if (output_of("/usr/bin/python3 -c 'import xarray, netCDF4; print(1)'") == "1\n") return;
    if (data_required()) FAIL() << "python3-xarray, python3-netcdf4 are absent: run scripts/setup";
    GTEST_SKIP() << "needs python3-xarray, python3-netcdf4";
  }
  std::string said(const std::string& expressions) const {
    return output_of("/usr/bin/python3 -c 'import xarray as x; d = x.open_dataset(\"" + folder_ / "out.nc" +
                     "\"); print(" + expressions + ")'");
  }
  TemporaryFolder folder_;
};

TEST_F(NetcdfInXarray, HasNamedCoordinates) {
  const Simulation scene = simulation_of(folder_, three_views);
  write_netcdf(scene, simulate(scene, 1), {"bpms simulate", 1, {}}, folder_ / "out.nc", {});
  EXPECT_EQ(said("d.brf.dims, d.brf.shape, sorted(d.brf.coords), d.vza.units, d.wavelength.units, "
                 "[float(v) for v in d.vza.values], round(float(d.brf[1, 0]), 5), "
                 "float(d.brf_se[1, 0]) < 1e-6, d.attrs[\"stopped_by\"], d.brf_by_component.dims"),
            "('view', 'band') (3, 2) ['vaa', 'vza', 'wavelength'] degree nm [-30.0, 0.0, 30.0] 0.2 True "
            "samples ('view', 'band', 'component')\n");
}

// Two images whose names are one when written as variables; by origin only when asked for.
TEST_F(NetcdfInXarray, HoldsImagesInSinglePrecision) {
  SceneText text = three_views;
  text.sky = white_sky;
  const std::string rest =
      "type = \"perspective\"\nlocation = [0, 0, 3]\nlook_at = [0.1, 0, 0]\nfov_deg = 20\nwidth_px = "
      "3\nheight_px = 2\n";
  text.sensor = "name = \"my camera\"\n" + rest + "[[sensors]]\nname = \"my-camera\"\n" + rest;
  const Simulation scene = simulation_of(folder_, text);
  const Result result = simulate(scene, 1);
  write_netcdf(scene, result, {"bpms simulate", 1, {}}, folder_ / "out.nc", {});
  const std::string about =
      "d.my_camera_radiance.dtype, d.my_camera_radiance.shape, \"my_camera_2_radiance_se\" in d, "
      "\"my_camera_radiance_by_origin\" in d";
  EXPECT_EQ(said(about), "float32 (2, 3, 2) True False\n");
  write_netcdf(scene, result, {"bpms simulate", 1, {}}, folder_ / "out.nc", {true, true});
  EXPECT_EQ(said(about), "float32 (2, 3, 2) True True\n");
}

TEST(Output, ReportHasTheKeysOfTheContract) {
  const TemporaryFolder folder;
  const Simulation scene = simulation_of(folder, three_views);
  const Json report = result_report(scene, simulate(scene, 3));
  for (const char* key : {"sensors", "samples", "seconds", "rays", "threads", "stopped_by", "seed", "version",
                          "series", "spectra", "images"})
    EXPECT_TRUE(report.contains(key)) << key;
  EXPECT_EQ(report["samples"], 3 * 64);
  EXPECT_EQ(report["seed"], 3);
  EXPECT_EQ(report["series"][0]["vza_deg"].size(), 3u);
}

}  // namespace
}  // namespace bpms::test
