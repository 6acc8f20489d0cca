// The CSV and the report as others read them. NetCDF in xarray: tests/output/xarray_test.cpp.
#include <gmock/gmock.h>

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

// Of many bands those nearest to 550, 670, 850 and 1650 nm have curves over the views; every view a spectrum.
TEST(Output, ReportDrawsAFewOfManyBandsOverTheViews) {
  const TemporaryFolder folder;
  SceneText text = three_views;
  text.wavelengths_nm = "[400, 450, 500, 540, 600, 650, 700, 750, 800, 900]";
  const Simulation scene = simulation_of(folder, text);
  const Json report = result_report(scene, simulate(scene, 3));
  std::vector<double> nm;
  for (const Json& series : report["series"])
    if (series["quantity"] == "brf" && series["origin"] == "total" && series["component"] == "all" &&
        series["order"].is_null())
      nm.push_back(series["wavelength_nm"]);
  EXPECT_THAT(nm, ::testing::ElementsAre(540, 650, 800, 900));  // 850: the first of two as near
  EXPECT_EQ(report["spectra"].size(), 3u);
  EXPECT_EQ(report["spectra"][0]["wavelength_nm"].size(), 10u);
}

}  // namespace
}  // namespace bpms::test
