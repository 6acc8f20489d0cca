// Fluxes from the light: energy, closed forms, the reverse mode, the same bits on any number of threads.
#include <gmock/gmock.h>

#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "core/units.h"
#include "simulate/forward/forward.h"
#include "tests/simulate/hemisphere.h"

namespace bpms::test {
namespace {

FluxResult fluxes_of(const Simulation& simulation, const FluxOptions& options = {}, std::uint64_t seed = 1) {
  const Intersector intersector(simulation.scene);
  return trace_fluxes(simulation, intersector, seed, options);
}

struct Value {
  double value, error;
};
Value flux(const FluxResult& result, Flux which, std::size_t band = 0, std::size_t origin = 0) {
  const std::size_t bands = result.entering[0].size(), at = result.row(which) * bands + band;
  return {result.fraction[origin].value[at], result.fraction[origin].standard_error[at]};
}
// Of all rows of this kind.
double sum_of(const FluxResult& result, Flux which, std::size_t band = 0) {
  double sum = 0;
  for (std::size_t r = 0; r < result.rows.size(); ++r)
    if (result.rows[r].flux == which) sum += result.fraction[0].value[r * result.entering[0].size() + band];
  return sum;
}

// A horizontal square [x0, x1] x [y0, y1] at height z, of one organ.
std::string square(double x0, double x1, double y0, double y1, double z) {
  return fmt::format(
      "g leaf1\nv {0} {2} {4}\nv {1} {2} {4}\nv {1} {3} {4}\nv {0} {3} {4}\nf 1 2 3\nf 1 3 4\n", x0, x1, y0,
      y1, z);
}

SceneText canopy(const TemporaryFolder& folder) {
  SceneText scene = canopy_text(folder, {.lai = 2, .size_m = {3, 3}, .bottom_m = 0.05});
  scene.sensor = views("[[0, 0]]");
  return scene;
}

TEST(Fluxes, WhatNothingAbsorbsIsAllReflected) {
  const TemporaryFolder folder;
  SceneText scene = canopy(folder);
  scene.leaf = bilambertian("0.5", "0.5");
  scene.soil = lambertian("1.0");
  scene.sun = sun_at(35, 20);
  scene.sky = white_sky;
  scene.sampling = "samples = 2048\nroulette = false";
  const FluxResult result = fluxes_of(simulation_of(folder, scene));
  for (std::size_t origin = 0; origin < 3; ++origin) {
    EXPECT_NEAR(flux(result, Flux::reflected, 0, origin).value, 1.0, 1e-12);
    EXPECT_EQ(flux(result, Flux::absorbed_canopy, 0, origin).value, 0.0);
    EXPECT_EQ(flux(result, Flux::absorbed_ground, 0, origin).value, 0.0);
  }
}

// One band and no roulette: each photon's energy closes, to the rounding of floats. Parts add up in any case.
TEST(Fluxes, EnergyCloses) {
  const TemporaryFolder folder;
  for (const bool roulette : {false, true}) {
    SceneText scene = canopy(folder);
    scene.leaf = bilambertian("[[600, 0.1], [800, 0.5]]", "[[600, 0.05], [800, 0.42]]");
    scene.soil = lambertian("0.3");
    scene.sun = sun_at(50, 20);
    scene.sky = white_sky;
    scene.wavelengths_nm = roulette ? "[600, 800]" : "[800]";
    scene.sampling = fmt::format("samples = 16384\nroulette = {}", roulette);
    const FluxResult result =
        fluxes_of(simulation_of(folder, scene), {.layers_m = {}, .layers = 7, .plants = true});
    for (std::size_t band = 0; band < (roulette ? 2u : 1u); ++band) {
      const Value reflected = flux(result, Flux::reflected, band),
                  transmitted = flux(result, Flux::transmitted, band),
                  canopy_part = flux(result, Flux::absorbed_canopy, band);
      const double sum = reflected.value + canopy_part.value + (1 - 0.3) * transmitted.value +
                         flux(result, Flux::lost_wraps, band).value;
      // The errors of parts of one photon at worst add up.
      const double error = reflected.error + canopy_part.error + transmitted.error;
      EXPECT_NEAR(sum, 1.0, roulette ? 4 * error : 1e-6);
      EXPECT_LT(error, 0.02);
      EXPECT_NEAR(flux(result, Flux::absorbed_ground, band).value, 0.7 * transmitted.value, 1e-6);
      EXPECT_NEAR(sum_of(result, Flux::absorbed_layer, band), canopy_part.value, 1e-12);
      EXPECT_NEAR(sum_of(result, Flux::absorbed_plant, band), canopy_part.value, 1e-12);
      EXPECT_NEAR(sum_of(result, Flux::absorbed_material, band),
                  canopy_part.value + flux(result, Flux::absorbed_ground, band).value, 1e-12);
      EXPECT_LT(flux(result, Flux::transmitted_direct, band).value,
                flux(result, Flux::transmitted_first, band).value);
      EXPECT_LT(flux(result, Flux::transmitted_first, band).value, transmitted.value);
    }
  }
}

// Over a ground that reflects rho: each return of light from a canopy of spherical albedo S to the ground is
// a factor rho S; here, without a canopy, none returns.
TEST(Fluxes, BareGround) {
  const TemporaryFolder folder;
  SceneText scene;
  scene.soil = lambertian("0.3");
  scene.ground = "soil";
  scene.sun = sun_at(60, 0);
  scene.sensor = views("[[0, 0]]");
  scene.sampling = "samples = 1024\nroulette = false";
  const FluxResult result = fluxes_of(simulation_of(folder, scene));
  EXPECT_NEAR(flux(result, Flux::reflected).value, 0.3, 1e-7);
  EXPECT_NEAR(flux(result, Flux::absorbed_ground).value, 0.7, 1e-7);
  EXPECT_NEAR(flux(result, Flux::transmitted_direct).value, 1.0, 1e-12);
  EXPECT_NEAR(result.entering[0][0], pi * 4, 1e-9);
  scene.sun.clear();
  scene.sky = white_sky;
  EXPECT_NEAR(flux(fluxes_of(simulation_of(folder, scene)), Flux::absorbed_ground).value, 0.7, 1e-7);
}

// A black card over the western half of a cell, the sun overhead.
TEST(Fluxes, GroundMapShowsTheShadow) {
  const TemporaryFolder folder;
  folder.write("card.obj", square(-1, 0, -1, 1, 0.5));
  SceneText scene;
  scene.leaf = bilambertian("0.0", "0.0");
  scene.soil = lambertian("0.0");
  scene.ground = "soil";
  scene.mesh = "card.obj";
  scene.sun = sun_at(0, 0);
  scene.sensor = views("[[0, 0]]");
  scene.sampling = "samples = 65536";
  const FluxResult result = fluxes_of(simulation_of(folder, scene), {.map_px = {4, 3}});
  EXPECT_NEAR(flux(result, Flux::transmitted).value, 0.5, 1e-9);  // Sobol points: half of them on either side
  EXPECT_NEAR(sum_of(result, Flux::absorbed_organ), 0.5, 1e-9);
  const std::size_t first = result.row(Flux::ground_irradiance);
  for (std::size_t pixel = 0; pixel < 12; ++pixel) {
    const bool shaded = pixel % 4 < 2;
    EXPECT_NEAR(result.fraction[0].value[first + pixel], shaded ? 0.0 : 1.0, shaded ? 1e-12 : 0.02);
  }
}

// An open scene: a leaf of 1 m2 at 1 m above black ground, the sun overhead. What it transmits reaches the
// ground below it by the form factor of two squares at the distance of their sides, 0.19982 (Siegel &
// Howell), and leaves through the sides else.
TEST(Fluxes, OpenSceneCountsWhatLeavesTheSides) {
  const TemporaryFolder folder;
  folder.write("leaf.obj", square(-0.5, 0.5, -0.5, 0.5, 1.0));
  SceneText scene;
  scene.domain = "boundary = \"open\"";
  scene.leaf = bilambertian("0.3", "0.6");
  scene.soil = lambertian("0.0");
  scene.ground = "soil";
  scene.mesh = "leaf.obj";
  scene.sun = sun_at(0, 0);
  scene.sensor = views("[[0, 0]]");
  scene.sampling = "samples = 262144";
  const FluxResult result = fluxes_of(simulation_of(folder, scene));
  const auto expect = [&](Flux which, double expected) {
    const Value found = flux(result, which);
    EXPECT_LT(std::abs(found.value - expected), 4 * found.error + 1e-6)
        << name_of(which) << " " << found.value;
  };
  expect(Flux::reflected, 0.3);
  expect(Flux::absorbed_canopy, 0.1);
  expect(Flux::transmitted, 0.6 * 0.19982);
  expect(Flux::lost_sides, 0.6 * (1 - 0.19982));
  // A slanting sun also comes in through two sides.
  scene.sun = sun_at(45, 0);
  EXPECT_NEAR(fluxes_of(simulation_of(folder, scene)).entering[0][0], pi * 2, 1e-6);
  // From the sky: the power through the top, and half of the hemisphere through each side.
  scene.sun.clear();
  scene.sky = white_sky;
  const FluxResult sky = fluxes_of(simulation_of(folder, scene));
  EXPECT_NEAR(sky.entering[0][0], pi * (1 + 2), 1e-6);
  // The leaf sees all of the sky from above, and from below what does not lie behind the ground: nothing.
  const Value absorbed = flux(sky, Flux::absorbed_canopy);
  EXPECT_LT(std::abs(absorbed.value - 0.1 / 3), 4 * absorbed.error);
}

TEST(Fluxes, ReflectedIsTheReverseModesDhr) {
  const TemporaryFolder folder;
  SceneText scene = canopy(folder);
  scene.leaf = bilambertian("0.6", "0.2") + "reflectance_back = 0.2";
  scene.soil = lambertian("0.4");
  scene.sun = sun_at(40, 130);
  scene.sampling = "samples = 262144";
  const Value forward = flux(fluxes_of(simulation_of(folder, scene)), Flux::reflected);
  scene.sensor.clear();
  scene.sampling = "samples = 2048";
  const Mean reverse = dhr(folder, scene);
  EXPECT_LT(std::abs(forward.value - reverse.value), 4 * std::hypot(forward.error, reverse.error))
      << forward.value << " and " << reverse.value;
  EXPECT_LT(std::hypot(forward.error, reverse.error), 0.01 * forward.value);
}

// An isotropic sky is the mean of suns, uniform over cos^2 of their zenith and over azimuth.
TEST(Fluxes, SkyIsTheMeanOfSuns) {
  const TemporaryFolder folder;
  SceneText scene = canopy(folder);
  scene.sky = white_sky;
  scene.sampling = "samples = 262144";
  const FluxResult sky = fluxes_of(simulation_of(folder, scene));
  scene.sky.clear();
  scene.sampling = "samples = 4096";
  constexpr int strata = 24, repeats = 4;
  std::vector<double> reflected, transmitted;
  Philox random(5);
  for (int repeat = 0; repeat < repeats; ++repeat) {
    double r = 0, t = 0;
    for (int k = 0; k < strata; ++k) {
      const double zenith = std::acos(std::sqrt((k + random.uniform()) / strata));
      scene.sun = sun_at(std::min(89.5, degrees(zenith)), 360 * random.uniform());
      const FluxResult sun =
          fluxes_of(simulation_of(folder, scene), {}, static_cast<std::uint64_t>(repeat + 2));
      r += flux(sun, Flux::reflected).value / strata, t += flux(sun, Flux::transmitted).value / strata;
    }
    reflected.push_back(r), transmitted.push_back(t);
  }
  const auto expect = [&](Flux which, const std::vector<double>& suns) {
    const Value one = flux(sky, which);
    const Mean mean = mean_of(suns);
    EXPECT_LT(std::abs(one.value - mean.value),
              6 * std::hypot(one.error, mean.error))  // of 4 draws: t, 3 d.o.f.
        << name_of(which) << " " << one.value << " and " << mean.value << " +- " << mean.error;
    EXPECT_LT(mean.error, 0.02 * mean.value);
  };
  expect(Flux::reflected, reflected);
  expect(Flux::transmitted, transmitted);
}

TEST(Fluxes, BandsBeyondALaneGroupAreAsByThemselves) {
  const TemporaryFolder folder;
  SceneText scene = canopy(folder);
  scene.leaf = bilambertian("[[500, 0.1], [900, 0.5]]", "[[500, 0.05], [900, 0.42]]");
  scene.sun = sun_at(30, 0);
  scene.sampling = "samples = 65536";
  scene.wavelengths_nm = "{ from = 500, to = 900, step = 25 }";  // 17 bands
  const FluxResult many = fluxes_of(simulation_of(folder, scene));
  scene.wavelengths_nm = "[650]";
  const FluxResult one = fluxes_of(simulation_of(folder, scene), {}, 2);
  for (const Flux which : {Flux::reflected, Flux::transmitted, Flux::absorbed_canopy}) {
    const Value a = flux(many, which, 6), b = flux(one, which);
    EXPECT_LT(std::abs(a.value - b.value), 4 * std::hypot(a.error, b.error)) << name_of(which);
  }
}

TEST(Fluxes, SameBitsOnAnyNumberOfThreads) {
  const TemporaryFolder folder;
  SceneText scene = canopy(folder);
  scene.sun = sun_at(30, 0);
  scene.sky = white_sky;
  scene.sampling = "target_se = 0.002";
  const Simulation simulation = simulation_of(folder, scene);
  std::vector<FluxResult> results;
  for (const int count : {1, 2, 7}) {
    set_threads(count);
    results.push_back(fluxes_of(simulation, {.layers = 3, .map_px = {5, 5}}));
  }
  set_threads(0);
  EXPECT_EQ(results[0].stopped_by, "target_se");
  for (const FluxResult& other : results) {
    EXPECT_EQ(other.fraction[0].value, results[0].fraction[0].value);
    EXPECT_EQ(other.fraction[0].standard_error, results[0].fraction[0].standard_error);
  }
}

}  // namespace
}  // namespace bpms::test
