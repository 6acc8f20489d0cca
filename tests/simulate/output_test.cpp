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

}  // namespace
}  // namespace bpms::test
