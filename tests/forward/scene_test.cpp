// Forward mode as a scene asks for it: flux sensors, and views that share paths, through the files of a
// result.
#include <gmock/gmock.h>

#include <cmath>

#include "core/csv.h"
#include "simulate/forward/forward.h"
#include "simulate/output/output.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

SceneText canopy(const TemporaryFolder& folder) {
  SceneText scene = canopy_text(folder, {.lai = 2, .radius_m = 0.05, .size_m = {2, 2}, .top_m = 1});
  scene.sun = sun_at(30, 0);
  scene.sampling = "samples = 16384";
  return scene;
}

TEST(ForwardScene, FluxesCloseInTheTable) {
  const TemporaryFolder folder;
  SceneText scene = canopy(folder);
  scene.sensor = "name = \"energy\"\ntype = \"flux\"\nlayers = 4\nplants = true\nmap_px = [4, 2]\n";
  const Simulation simulation = simulation_of(folder, scene);
  const Result result = simulate(simulation, 1);
  ASSERT_EQ(result.fluxes.size(), 1u);
  const CsvTable table = CsvTable::parse("fluxes.csv", result_csv(simulation, result));
  const int quantity = table.require("quantity"), of = table.require("material"),
            value = table.require("value"), error = table.require("standard_error");
  double sum = 0, squares = 0, layers = 0, canopy_part = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string_view what = table.text(row, quantity);
    double factor = 0;
    if (what == "absorbed_canopy") factor = 1, canopy_part = table.number(row, value);
    if (what == "reflected" || what == "lost_wraps") factor = 1;
    if (what == "transmitted") factor = 1 - 0.2;  // the soil's reflectance
    sum += factor * table.number(row, value);
    squares += std::pow(factor * table.number(row, error), 2);
    if (what == "absorbed" && table.text(row, of).ends_with(" m")) layers += table.number(row, value);
  }
  EXPECT_NEAR(sum, 1, 4 * std::sqrt(squares));
  EXPECT_NEAR(layers, canopy_part, 1e-5);  // of seven digits
  write_netcdf(simulation, result, {}, folder / "fluxes.nc", {});
}

TEST(ForwardScene, SharedPathsAreAskedForByTheirKey) {
  const TemporaryFolder folder;
  SceneText scene = canopy(folder);
  scene.sensor = views("[[0, 0], [30, 180], [-45, 180]]");
  const SensorResult apart = sensor_result(folder, scene);
  EXPECT_TRUE(apart.covariance.empty());
  scene.sampling += "\nshare_paths = true";
  const SensorResult shared = sensor_result(folder, scene, 2);
  ASSERT_EQ(shared.covariance.size(), 9u);
  for (std::size_t view = 0; view < 3; ++view) {
    EXPECT_LT(std::abs(z_of(apart.radiance[0], view, shared.radiance[0], view)), 4);
    EXPECT_NEAR(std::sqrt(shared.covariance[view * 4]), shared.radiance[0].standard_error[view], 1e-9);
  }
}

TEST(ForwardScene, RefusesWhatCannotShare) {
  const TemporaryFolder folder;
  SceneText scene = canopy(folder);
  scene.sensor = camera("[0, 0, 5]", "direction = [0, 0, -1]\nfov_deg = 10\nup = [0, 1, 0]", 2, 2);
  scene.sampling = "samples = 64\nmode = \"forward\"";
  BPMS_EXPECT_ERROR(simulate(simulation_of(folder, scene), 1), ErrorKind::bad_input, "cannot share paths");
  scene.sampling = "samples = 64\nmode = \"reverse\"\nshare_paths = true";
  BPMS_EXPECT_ERROR(simulation_of(folder, scene), ErrorKind::bad_input, "share_paths");
}

}  // namespace
}  // namespace bpms::test
