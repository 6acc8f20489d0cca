// Standard errors are honest, results do not depend on threads, bundles do not depend on how bands travel.
#include <gmock/gmock.h>

#include <cmath>

#include "core/parallel.h"
#include "tests/simulate/random_canopy.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

// One disc over half of a small cell: cheap, with light of many orders.
std::string one_disc(const TemporaryFolder& folder, const std::string& bands, const std::string& reflectance,
                     const std::string& sampling) {
  folder.write("disc.def", "0.4 0.1 0.0 0.5 0.3 0.2 0.93\n0.3 -0.2 0.1 0.3 0.0 0.7 0.71\n");
  return "[domain]\nsize_m = [1, 1]\n[materials.leaf]\ntype = \"bilambertian\"\nreflectance = " +
         reflectance + R"(
transmittance = 0.4
[materials.soil]
type = "lambertian"
reflectance = 0.3
[ground]
type = "plane"
material = "soil"
[prototypes.disc]
discs = "disc.def"
material = "leaf"
[[instances]]
prototype = "disc"
positions = [[0, 0, 0]]
[illumination]
sun = { zenith_deg = 40.0, azimuth_deg = 50.0, irradiance = "brf" }
sky = { type = "isotropic", irradiance = "brf" }
[[sensors]]
name = "views"
type = "brf"
views = [[20, 100], [50, 210]]
)" + bands +
         "[sampling]\n" + sampling;
}

TEST(Statistics, StandardErrorsCoverAsStudentsTSays) {
  const TemporaryFolder folder;
  Simulation scene = simulation_of(folder, one_disc(folder, "", "0.5", "samples = 512\n"));
  const Intersector intersector(scene.scene);
  scene.sampling.samples = 1 << 19;
  const double truth = simulate(scene, intersector, 999).sensors[0].radiance[0].value[0];
  scene.sampling.samples = 512;
  constexpr int repeats = 1000;
  int within68 = 0, within95 = 0;
  for (int r = 0; r < repeats; ++r) {
    const SensorResult result = simulate(scene, intersector, static_cast<std::uint64_t>(r + 1)).sensors[0];
    const double t = std::abs(result.radiance[0].value[0] - truth) / result.radiance[0].standard_error[0];
    within68 += t < 1.0105;  // Student's t with 31 degrees of freedom
    within95 += t < 2.0395;
  }
  const auto sd = [](double p) { return std::sqrt(p * (1 - p) / repeats); };
  EXPECT_NEAR(within68 / static_cast<double>(repeats), 0.68, 4 * sd(0.68));
  EXPECT_NEAR(within95 / static_cast<double>(repeats), 0.95, 4 * sd(0.95));
}

TEST(Statistics, SameBitsOnAnyNumberOfThreads) {
  const TemporaryFolder folder;
  for (const char* sampling : {"samples = 4096\n", "target_se = \"1%\"\n"}) {
    const Simulation scene = simulation_of(folder, one_disc(folder, "", "0.5", sampling));
    set_threads(1);
    const SensorResult one = simulate(scene, 5).sensors[0];
    for (const int count : {2, 7}) {
      set_threads(count);
      const SensorResult many = simulate(scene, 5).sensors[0];
      EXPECT_EQ(many.samples, one.samples);
      for (std::size_t p = 0; p < one.parts.size(); ++p) {
        EXPECT_EQ(many.radiance[p].value, one.radiance[p].value);
        EXPECT_EQ(many.radiance[p].standard_error, one.radiance[p].standard_error);
      }
      EXPECT_EQ(many.sunlit.value, one.sunlit.value);
    }
    set_threads(0);
  }
}

TEST(Statistics, TargetsAreMetAndLimitsAreNamed) {
  const TemporaryFolder folder;
  const Simulation scene = simulation_of(folder, one_disc(folder, "", "0.5", "target_se = 0.002\n"));
  const Result result = simulate(scene, 5);
  EXPECT_EQ(result.stopped_by, "target_se");
  for (const double error : result.sensors[0].radiance[0].standard_error) EXPECT_LE(error, 0.002);
  const Result limited = simulate(
      simulation_of(folder, one_disc(folder, "", "0.5", "target_se = 1e-6\nmax_samples = 5000\n")), 5);
  EXPECT_EQ(limited.stopped_by, "max_samples");
  for (const std::uint64_t samples : limited.sensors[0].samples) EXPECT_LE(samples, 5000u);
}

// Twelve equal bands travel as counted interactions, one as a weight: the same paths, the same sums.
TEST(Statistics, CountedInteractionsGiveWhatCarriedBandsGive) {
  const TemporaryFolder folder;
  const std::string sampling = "samples = 4096\norders = 6\n";
  const SensorResult one =
      simulate(simulation_of(folder, one_disc(folder, "", "0.5", sampling)), 5).sensors[0];
  const std::string bands = "[bands]\nwavelengths_nm = [400,450,500,550,600,650,700,750,800,850,900,950]\n";
  const SensorResult many =
      simulate(simulation_of(folder, one_disc(folder, bands, "0.5", sampling)), 5).sensors[0];
  ASSERT_EQ(one.parts.size(), many.parts.size());
  for (std::size_t p = 0; p < one.parts.size(); ++p)
    for (std::size_t view = 0; view < 2; ++view)
      for (std::size_t band = 0; band < 12; ++band) {
        EXPECT_NEAR(many.radiance[p].value[view * 12 + band], one.radiance[p].value[view], 2e-6);
        EXPECT_NEAR(many.radiance[p].standard_error[view * 12 + band], one.radiance[p].standard_error[view],
                    2e-6);
      }
}

// A spectrum that varies: every band agrees with a run of that band alone.
TEST(Statistics, EachBandOfABundleAgreesWithARunOfItsOwn) {
  const TemporaryFolder folder;
  const std::string bands = "[bands]\nwavelengths_nm = [400,450,500,550,600,650,700,750,800,850,900,1000]\n";
  const SensorResult all =
      simulate(
          simulation_of(folder, one_disc(folder, bands, "[[400, 0.0], [1000, 0.6]]", "samples = 65536\n")), 5)
          .sensors[0];
  for (const std::size_t band : {0u, 5u, 11u}) {
    const double nm = band == 0 ? 400 : band == 5 ? 650 : 1000;
    const SensorResult own =
        simulate(simulation_of(folder, one_disc(folder, "", fmt::format("{}", 0.6 * (nm - 400) / 600),
                                                "samples = 65536\n")),
                 6)
            .sensors[0];
    for (std::size_t view = 0; view < 2; ++view) {
      const double a = all.radiance[0].value[view * 12 + band],
                   ea = all.radiance[0].standard_error[view * 12 + band];
      const double b = own.radiance[0].value[view], eb = own.radiance[0].standard_error[view];
      EXPECT_LT(std::abs(a - b) / std::hypot(ea, eb), 4) << nm << " nm: " << a << " and " << b;
    }
  }
}

TEST(Statistics, PartsAddUp) {
  const TemporaryFolder folder;
  const SensorResult r =
      simulate(simulation_of(folder, one_disc(folder, "", "0.5", "samples = 4096\n")), 5).sensors[0];
  for (std::size_t view = 0; view < 2; ++view) {
    const auto value = [&](Origin origin, Component component = Component::all, int order = every_order) {
      return part_of(r, origin, component, order).value[view];
    };
    EXPECT_NEAR(value(Origin::direct) + value(Origin::diffuse), value(Origin::total), 1e-12);
    EXPECT_NEAR(value(Origin::direct, Component::uc_sgl) + value(Origin::direct, Component::co_sgl) +
                    value(Origin::direct, Component::mlt),
                value(Origin::direct), 1e-12);
    double orders = 0;
    for (std::size_t p = 0; p < r.parts.size(); ++p)
      if (r.parts[p].order != every_order && r.parts[p].origin == Origin::total)
        orders += r.radiance[p].value[view];
    EXPECT_NEAR(orders, value(Origin::total), 1e-12);
  }
}

}  // namespace
}  // namespace bpms::test
