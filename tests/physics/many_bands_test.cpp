// Many bands in one run where materials are no product of spectra and shapes: each band as in a run of its
// own. Lambertian bands are in tests/simulate/statistics_test.cpp.
#include "tests/physics/physics.h"

namespace bpms::test {
namespace {

constexpr int most_bands = 12;
constexpr int first_nm = 500, step_nm = 10;

std::string rising(double from, double to) {
  return fmt::format("[[{}, {}], [{}, {}]]", first_nm, from, first_nm + step_nm * (most_bands - 1), to);
}

// `bands`: the first so many of the twelve carried together; then some of them alone.
void expect_each_alone(SceneText scene, int bands, const TemporaryFolder& folder) {
  scene.sun = sun_at(35, 100);
  scene.sky = white_sky;
  scene.sensor = views("[[0, 0], [45, 100], [60, 280]]");
  scene.sampling = "samples = 65536";
  scene.wavelengths_nm = "[";
  for (int band = 0; band < bands; ++band)
    scene.wavelengths_nm += fmt::format("{}, ", first_nm + step_nm * band);
  scene.wavelengths_nm += "]";
  const SensorResult all = run_of(folder, scene, "", 1);
  for (const int band : {0, bands / 2, bands - 1}) {
    scene.wavelengths_nm = fmt::format("[{}]", first_nm + step_nm * band);
    const SensorResult one = run_of(folder, scene, "", 2);
    for (const Origin origin : {Origin::total, Origin::direct, Origin::diffuse})
      for (std::size_t view = 0; view < 3; ++view) {
        const Estimates& a = part_of(all, origin);
        const Estimates& b = part_of(one, origin);
        const std::size_t at = view * static_cast<std::size_t>(bands) + static_cast<std::size_t>(band);
        expect_agree({a.value[at], a.standard_error[at]}, {b.value[view], b.standard_error[view]}, 0.02,
                     fmt::format("{} bands, band {}, {}, view {}", bands, band, name_of(origin), view));
      }
  }
}

TEST(ManyBands, OverASoilWhoseShapeChangesWithThem) {
  const TemporaryFolder folder;
  SceneText scene = mixed_canopy(folder);
  scene.leaf = bilambertian(rising(0.05, 0.5), rising(0.03, 0.45));
  scene.soil = "type = \"rpv\"\nrho0 = " + rising(0.05, 0.3) + "\nk = " + rising(0.6, 0.9) +
               "\ntheta = " + rising(-0.3, 0.1) + "\n";
  expect_each_alone(scene, 4, folder);
  expect_each_alone(scene, most_bands, folder);
}

TEST(ManyBands, OnLeavesWhoseShineChangesWithThem) {
  const TemporaryFolder folder;
  SceneText scene = mixed_canopy(folder);
  scene.leaf = "type = \"waxy_leaf\"\nreflectance = " + rising(0.05, 0.45) +
               "\ntransmittance = " + rising(0.04, 0.45) + "\nrefractive_index = " + rising(1.35, 1.6) +
               "\nroughness = 0.4\n";
  expect_each_alone(scene, 4, folder);
  expect_each_alone(scene, most_bands, folder);
}

}  // namespace
}  // namespace bpms::test
