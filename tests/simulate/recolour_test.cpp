// Other spectra from the histogram of interactions.
#include "simulate/recolour/recolour.h"

#include <gmock/gmock.h>

#include <cmath>

#include "simulate/output/output.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

class Recolour : public testing::Test {
 protected:
  Recolour() {
    scene = canopy_text(folder, {.lai = 2, .radius_m = 0.05, .size_m = {2, 2}, .top_m = 1});
    scene.sun = sun_at(30, 0);
    scene.sky = white_sky;
    scene.sensor = views("[[0, 0], [45, 180]]");
    scene.sampling = "samples = 16384";
    scene.wavelengths_nm = "[650, 850]";
  }
  // Traces with the scene's spectra and keeps the interactions in a file.
  std::string record(std::uint64_t seed = 1) {
    Simulation simulation = simulation_of(folder, scene);
    simulation.sampling.keep_interactions = true;
    traced = simulate(simulation, seed);
    const std::string path = (folder / "out.nc");
    write_netcdf(simulation, traced, {}, path, {.overwrite = true});
    traced.sensors[0].sensor = nullptr;  // lives no longer than the simulation
    return path;
  }
  Result recoloured(const std::string& materials, std::uint64_t seed = 1,
                    Derivatives* derivatives = nullptr) {
    recording = read_recording(record(seed));
    with = recoloured_simulation(recording, folder.write("other.toml", materials));
    return recolour(recording, with, derivatives);
  }
  static std::string table(const std::string& name, const std::string& body) {
    return "[materials." + name + "]\n" + body + "\n";
  }

  TemporaryFolder folder;
  SceneText scene;
  Result traced;
  Recording recording;
  Simulation with;
};

TEST_F(Recolour, TheSameSpectraGiveTheSameNumbers) {
  const Result result = recoloured(table("leaf", scene.leaf) + table("soil", scene.soil));
  const SensorResult &before = traced.sensors[0], &after = result.sensors[0];
  for (const Part& part :
       {Part{}, Part{Origin::direct}, Part{Origin::diffuse}, Part{Origin::direct, Component::uc_sgl},
        Part{Origin::direct, Component::mlt}, Part{Origin::total, Component::all, 3}}) {
    const Estimates& a = part_of(before, part.origin, part.component, part.order);
    const Estimates& b = part_of(after, part.origin, part.component, part.order);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(a.value[i], b.value[i], 1e-12);
      EXPECT_NEAR(a.standard_error[i], b.standard_error[i], 1e-12);
    }
  }
}

TEST_F(Recolour, OtherSpectraAgreeWithARunOfTheirOwn) {
  const std::string leaf = bilambertian("[[650, 0.08], [850, 0.42]]", "[[650, 0.03], [850, 0.5]]");
  const std::string soil = lambertian("[[650, 0.35], [850, 0.4]]");
  const Result result = recoloured(table("leaf", leaf) + table("soil", soil), 5);
  scene.leaf = leaf;
  scene.soil = soil;
  const SensorResult own = sensor_result(folder, scene, 9);
  for (const Origin origin : {Origin::total, Origin::direct, Origin::diffuse})
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT(std::abs(z_of(part_of(own, origin), i, part_of(result.sensors[0], origin), i)), 4);
}

// By central differences of recoloured results: the paths are the same, so the difference has no noise.
TEST_F(Recolour, DerivativesAreThoseOfTheResult) {
  Derivatives derivatives;
  recoloured(table("leaf", bilambertian("0.4", "0.3")), 1, &derivatives);
  ASSERT_THAT(derivatives.factors,
              testing::ElementsAre("soil.reflectance", "soil.reflectance_back", "soil.transmittance",
                                   "leaf.reflectance", "leaf.reflectance_back", "leaf.transmittance"));
  constexpr double h = 1e-4;
  const auto total = [&](double transmittance) {
    return recoloured(table("leaf", bilambertian("0.4", fmt::format("{:.9g}", transmittance))))
        .sensors[0]
        .radiance[0];
  };
  const Estimates more = total(0.3 + h), less = total(0.3 - h);
  for (std::size_t i = 0; i < 4; ++i) {
    const double slope = derivatives.by_sensor[0].value[i * 6 + 5];
    EXPECT_GT(slope, 0.1);
    EXPECT_NEAR((more.value[i] - less.value[i]) / (2 * h), slope, 1e-5 * slope);
    EXPECT_GT(derivatives.by_sensor[0].standard_error[i * 6 + 5], 0);
  }
}

TEST_F(Recolour, OtherWavelengthsNeedAllSpectra) {
  const std::string bands = "[bands]\nwavelengths_nm = [700, 710, 720]\n";
  EXPECT_THROW(recoloured(bands + table("leaf", bilambertian("0.2", "0.2"))), Error);
  const Result result = recoloured(bands + table("leaf", bilambertian("[[700, 0.1], [720, 0.3]]", "0.2")) +
                                   table("soil", lambertian("0.2")));
  EXPECT_EQ(result.sensors[0].radiance[0].value.size(), 6u);
  EXPECT_LT(result.sensors[0].radiance[0].value[0], result.sensors[0].radiance[0].value[2]);
}

TEST_F(Recolour, RefusesWaysThatNoPathWent) {
  scene.leaf = bilambertian("0.5", "0");
  EXPECT_THROW(recoloured(table("leaf", bilambertian("0.5", "0.1"))), Error);
  EXPECT_THROW(recoloured(table("laef", bilambertian("0.5", "0"))), Error);
}

TEST_F(Recolour, RefusesFilesWithoutAHistogram) {
  Simulation simulation = simulation_of(folder, scene);
  write_netcdf(simulation, simulate(simulation, 1), {}, (folder / "plain.nc"), {});
  EXPECT_THROW(read_recording((folder / "plain.nc")), Error);
  EXPECT_THROW(read_recording(folder.write("no.nc", "text")), Error);
  EXPECT_THROW(read_recording((folder / "absent.nc")), Error);
}

}  // namespace
}  // namespace bpms::test
