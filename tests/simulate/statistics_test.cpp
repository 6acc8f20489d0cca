// Standard errors are honest, results do not depend on threads, bundles do not depend on how bands travel.
#include <gmock/gmock.h>

#include <cmath>

#include "core/parallel.h"
#include "tests/simulate/scene_text.h"

namespace bpms::test {
namespace {

// One disc over half of a small cell: cheap, with light of many orders.
SceneText one_disc(const TemporaryFolder& folder, const std::string& sampling,
                   const std::string& reflectance = "0.5", const std::string& wavelengths_nm = "") {
  folder.write("disc.def", "0.4 0.1 0.0 0.5 0.3 0.2 0.93\n0.3 -0.2 0.1 0.3 0.0 0.7 0.71\n");
  return {.domain = "size_m = [1, 1]",
          .leaf = bilambertian(reflectance, "0.4"),
          .soil = lambertian("0.3"),
          .discs = "disc.def",
          .sun = sun_at(40, 50),
          .sky = white_sky,
          .sensor = views("[[20, 100], [50, 210]]"),
          .wavelengths_nm = wavelengths_nm,
          .sampling = sampling};
}

TEST(Statistics, StandardErrorsCoverAsStudentsTSays) {
  const TemporaryFolder folder;
  Simulation scene = simulation_of(folder, one_disc(folder, "samples = 512\n"));
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
  const SceneText views = one_disc(folder, "samples = 4096"),
                  to_target = one_disc(folder, "target_se = \"1%\"");
  SceneText image = one_disc(folder, "samples = 32");
  image.sensor = camera("[0, 0, 3]", "look_at = [0.2, 0, 0]\nup = [0, 1, 0]\nfov_deg = 20", 24, 16);
  for (const SceneText& text : {views, to_target, image}) {
    const Simulation scene = simulation_of(folder, text);
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
      EXPECT_EQ(many.gap.value, one.gap.value);
    }
    set_threads(0);
  }
}

TEST(Statistics, TargetsAreMetAndLimitsAreNamed) {
  const TemporaryFolder folder;
  const Simulation scene = simulation_of(folder, one_disc(folder, "target_se = 0.002\n"));
  const Result result = simulate(scene, 5);
  EXPECT_EQ(result.stopped_by, "target_se");
  for (const double error : result.sensors[0].radiance[0].standard_error) EXPECT_LE(error, 0.002);
  const Result limited =
      simulate(simulation_of(folder, one_disc(folder, "target_se = 1e-6\nmax_samples = 5000\n")), 5);
  EXPECT_EQ(limited.stopped_by, "max_samples");
  for (const std::uint64_t samples : limited.sensors[0].samples) EXPECT_LE(samples, 5000u);
}

// Twelve equal bands travel as counted interactions, one as a weight: the same paths, the same sums.
TEST(Statistics, CountedInteractionsGiveWhatCarriedBandsGive) {
  const TemporaryFolder folder;
  const std::string sampling = "samples = 4096\norders = 6\n";
  const SensorResult one = sensor_result(folder, one_disc(folder, sampling), 5);
  const std::string bands = "[400,450,500,550,600,650,700,750,800,850,900,950]";
  const SensorResult many = sensor_result(folder, one_disc(folder, sampling, "0.5", bands), 5);
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
  const std::string bands = "[400,450,500,550,600,650,700,750,800,850,900,1000]";
  const SensorResult all =
      sensor_result(folder, one_disc(folder, "samples = 65536", "[[400, 0.0], [1000, 0.6]]", bands), 5);
  for (const std::size_t band : {0u, 5u, 11u}) {
    const double nm = band == 0 ? 400 : band == 5 ? 650 : 1000;
    const std::string reflectance = fmt::format("{}", 0.6 * (nm - 400) / 600);
    const SensorResult own = sensor_result(folder, one_disc(folder, "samples = 65536", reflectance), 6);
    for (std::size_t view = 0; view < 2; ++view)
      EXPECT_LT(std::abs(z_of(all.radiance[0], view * 12 + band, own.radiance[0], view)), 4) << nm << " nm";
  }
}

TEST(Statistics, PartsAddUp) {
  const TemporaryFolder folder;
  const SensorResult r = sensor_result(folder, one_disc(folder, "samples = 4096\n"), 5);
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
