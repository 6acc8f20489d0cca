// Fluxes from the light: energy, closed forms, the reverse mode, the same bits on any number of threads.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "core/units.h"
#include "simulate/forward/forward.h"
#include "simulate/transport/basis.h"
#include "tests/forward/lights.h"
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

// Lambert's law as a lobe.
class LambertLobe : public Lobe {
 public:
  float shape(const Eigen::Vector3f&, const Eigen::Vector3f& light) const override {
    return light.z() > 0 ? static_cast<float>(1 / pi) : 0.0f;
  }
  bool sample(const Eigen::Vector3f&, float u, float v, Eigen::Vector3f& light) const override {
    light = cosine_direction(Eigen::Vector3f::UnitZ(), static_cast<double>(u), static_cast<double>(v));
    return true;
  }
  float pdf(const Eigen::Vector3f&, const Eigen::Vector3f& light) const override {
    return std::max(0.0f, light.z()) * static_cast<float>(1 / pi);
  }
};

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

// A sky that brightens to one side, over black ground: all of it arrives. The same everywhere, over a canopy:
// as the isotropic one.
TEST(Fluxes, SkyMapsCarryTheirIrradiance) {
  const TemporaryFolder folder;
  const auto with_map = [&](const SceneText& text, bool even) {
    return with_sky_map(
        simulation_of(folder, text), [even](std::size_t row, std::size_t column, std::size_t) {
          return even ? 2.0f
                      : 1.0f + static_cast<float>(row) * (1 + std::sin(static_cast<float>(column) * 0.2618f));
        });
  };
  SceneText scene;
  scene.soil = lambertian("0.0");
  scene.ground = "soil";
  scene.sky = white_sky;
  scene.sensor = views("[[0, 0]]");
  scene.sampling = "samples = 65536\nroulette = false";
  const Value all = flux(fluxes_of(with_map(scene, false)), Flux::transmitted);
  EXPECT_NEAR(all.value, 1.0, 4 * all.error + 1e-3);  // the map's own quadrature
  EXPECT_LT(all.error, 1e-3);
  scene = canopy(folder);
  scene.sky = white_sky;
  scene.sampling = "samples = 131072";
  const Value even = flux(fluxes_of(with_map(scene, true)), Flux::reflected),
              plain = flux(fluxes_of(simulation_of(folder, scene), {}, 2), Flux::reflected);
  EXPECT_NEAR(even.value, plain.value, 4 * std::hypot(even.error, plain.error) + 1e-3);
}

// A disc of a sun as wide as a lampshade: what arrives is its irradiance, and what it lights is the mean of
// directions in it.
TEST(Fluxes, DiscsOfSunsAreTheMeanOfTheirDirections) {
  const TemporaryFolder folder;
  SceneText scene = canopy(folder);
  scene.sun = sun_at(50, 30);
  scene.sampling = "samples = 131072";
  Simulation simulation = simulation_of(folder, scene);
  simulation.light.suns[0].radius = radians(10);
  const FluxResult disc = fluxes_of(simulation);
  const Value direct = flux(disc, Flux::transmitted_direct);
  // Directions evenly over the disc, each with its cosine.
  double sum = 0, weight = 0, error = 0;
  std::uint64_t seed = 2;
  for (const Eigen::Vector3d& direction :
       disc_directions(simulation.light.suns[0].direction, radians(10), 8, 12)) {
    Simulation one = simulation_of(folder, scene);
    one.sampling.samples = 4096;
    one.light.suns[0].direction = direction;
    const Value value = flux(fluxes_of(one, {}, seed++), Flux::transmitted_direct);
    const double cosine = direction.z();
    sum += cosine * value.value, weight += cosine, error += cosine * cosine * value.error * value.error;
  }
  EXPECT_LT(std::abs(direct.value - sum / weight), 4.5 * std::hypot(direct.error, std::sqrt(error) / weight))
      << direct.value << " and " << sum / weight;
  EXPECT_NEAR(flux(disc, Flux::reflected).value + flux(disc, Flux::absorbed_canopy).value +
                  0.8 * flux(disc, Flux::transmitted).value,
              1.0, 0.02);
}

// Half of the leaves' reflectance as a lobe of the same law: the same fluxes, and energy still closes.
TEST(Fluxes, LobesScatterAsTheyShould) {
  const TemporaryFolder folder;
  SceneText scene = canopy(folder);
  scene.sun = sun_at(40, 20);
  scene.sampling = "samples = 262144";
  const FluxResult plain = fluxes_of(simulation_of(folder, scene));
  Simulation simulation = simulation_of(folder, scene);
  for (Material& material : simulation.materials) {
    if (material.name != "leaf") continue;
    material.reflectance = {{{0.25}, {0.25}}};
    material.lobes.push_back({std::make_shared<LambertLobe>(), {0.25}, {true, true}});
  }
  const FluxResult lobes = fluxes_of(simulation, {.layers = 4}, 2);
  for (const Flux which :
       {Flux::reflected, Flux::transmitted, Flux::absorbed_canopy, Flux::absorbed_ground}) {
    const Value a = flux(plain, which), b = flux(lobes, which);
    EXPECT_LT(std::abs(a.value - b.value), 4.5 * std::hypot(a.error, b.error)) << name_of(which);
    EXPECT_LT(b.error, 0.02 * b.value);
  }
  EXPECT_NEAR(sum_of(lobes, Flux::absorbed_layer), flux(lobes, Flux::absorbed_canopy).value, 1e-9);
}

// An open scene: a crown of leaves over ground that the box cuts off.
SceneText open_crown(const TemporaryFolder& folder) {
  SceneText scene = canopy_text(folder, {.lai = 2, .size_m = {1, 1}, .bottom_m = 0.2});
  scene.domain = "boundary = \"open\"";
  scene.sensor = views("[[0, 0]]");
  return scene;
}
// All that enters comes out or stays.
void expect_energy_to_close(const FluxResult& result, double soil) {
  double sum = 0, error = 0;
  for (const auto& [which, factor] :
       {std::pair(Flux::reflected, 1.0), std::pair(Flux::absorbed_canopy, 1.0),
        std::pair(Flux::lost_sides, 1.0), std::pair(Flux::transmitted, 1 - soil)}) {
    const Value part = flux(result, which);
    sum += factor * part.value, error += factor * part.error;
  }
  EXPECT_NEAR(sum, 1, 4 * error);
  EXPECT_LT(error, 0.02);
}

// A disc of a sun over an open scene: the power that enters and the fluxes are the means over its directions,
// each by what it sends into the box.
TEST(Fluxes, OpenScenesUnderADiscAreTheMeanOfItsDirections) {
  const TemporaryFolder folder;
  SceneText scene = open_crown(folder);
  scene.sun = sun_at(65, 30);
  scene.sampling = "samples = 131072";
  constexpr double radius = radians(15);
  Simulation simulation = simulation_of(folder, scene);
  simulation.light.suns[0].radius = radius;
  const FluxResult disc = fluxes_of(simulation);
  expect_energy_to_close(disc, 0.2);
  const std::array which{Flux::reflected, Flux::transmitted_direct, Flux::absorbed_canopy, Flux::lost_sides};
  std::array<double, 4> sum{}, error{};
  double weight = 0;
  const std::vector<Eigen::Vector3d> directions =
      disc_directions(simulation.light.suns[0].direction, radius, 6, 12);
  std::uint64_t seed = 2;
  for (const Eigen::Vector3d& direction : directions) {
    Simulation one = simulation_of(folder, scene);
    one.sampling.samples = 4096;
    one.light.suns[0].direction = direction;
    const FluxResult result = fluxes_of(one, {}, seed++);
    // Its irradiance is that on the plane normal to it.
    const double power = result.entering[0][0];
    weight += power;
    for (std::size_t i = 0; i < which.size(); ++i) {
      const Value value = flux(result, which[i]);
      sum[i] += power * value.value, error[i] += std::pow(power * value.error, 2);
    }
  }
  // The mean of a disc of even radiance is 2 / (1 + cos r) of its irradiance (see docs/physics.md).
  EXPECT_NEAR(disc.entering[0][0],
              weight / static_cast<double>(directions.size()) * 2 / (1 + std::cos(radius)),
              1e-3 * disc.entering[0][0]);  // of the quadrature with 72 directions
  for (std::size_t i = 0; i < which.size(); ++i) {
    const Value found = flux(disc, which[i]);
    EXPECT_LT(std::abs(found.value - sum[i] / weight),
              4 * std::hypot(found.error, std::sqrt(error[i]) / weight) + 1e-3)
        << name_of(which[i]) << " " << found.value << " and " << sum[i] / weight;
  }
}

// A sky map of one brightness is the isotropic sky; one that is bright on one side sends in what its
// quadrature says, and all of it comes out again.
TEST(Fluxes, OpenScenesUnderSkyMaps) {
  const TemporaryFolder folder;
  const auto with_map = [&](const SceneText& text, bool even) {
    return with_sky_map(simulation_of(folder, text), [even](std::size_t, std::size_t column, std::size_t) {
      return even ? 1.0f : column < 12 ? 4.0f : 0.5f;
    });
  };
  SceneText scene = open_crown(folder);
  scene.sky = white_sky;
  scene.sampling = "samples = 262144";
  const FluxResult plain = fluxes_of(simulation_of(folder, scene)),
                   even = fluxes_of(with_map(scene, true), {}, 2);
  EXPECT_NEAR(even.entering[0][0], plain.entering[0][0], 1e-4 * plain.entering[0][0]);
  for (const Flux which : {Flux::reflected, Flux::transmitted, Flux::transmitted_direct,
                           Flux::absorbed_canopy, Flux::lost_sides}) {
    const Value a = flux(even, which), b = flux(plain, which);
    EXPECT_LT(std::abs(a.value - b.value), 4.5 * std::hypot(a.error, b.error)) << name_of(which);
  }
  expect_energy_to_close(even, 0.2);
  const FluxResult uneven = fluxes_of(with_map(scene, false), {}, 3);
  expect_energy_to_close(uneven, 0.2);
  // Bright where the azimuth, clockwise from north, is below 180 degrees: the east. The ground's eastern
  // half, less in the crown's shade, gets more; in the mirror it would be the western one.
  const FluxResult mapped = fluxes_of(with_map(scene, false), {.map_px = {2, 1}}, 4);
  const std::size_t first = mapped.row(Flux::ground_irradiance);
  const double west = mapped.fraction[0].value[first], east = mapped.fraction[0].value[first + 1];
  EXPECT_GT(east, 1.05 * west);
}

// The same leaf in two ways: its left half a cut-out, its right half green, by a map; and as a leaf of half
// the size.
TEST(Fluxes, MapsOfMaterialsAreTheMaterialsThereAre) {
  const TemporaryFolder folder;
  // (U,V) of the square: U along x.
  folder.write("leaf.obj",
               "g leaf1\nv -1 -1 0.5\nv 1 -1 0.5\nv 1 1 0.5\nv -1 1 0.5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
               "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  folder.write("half.obj", square(0, 1, -1, 1, 0.5));
  folder.write("halves.pgm", "P2\n2 1\n1\n0 1\n");
  SceneText scene;
  scene.leaf = bilambertian("0.4", "0.3");
  scene.soil = lambertian("0.2");
  scene.ground = "soil";
  scene.mesh = "half.obj";
  scene.sun = sun_at(20, 40);
  scene.sky = white_sky;
  scene.sensor = views("[[0, 0]]");
  scene.sampling = "samples = 131072";
  const FluxResult half = fluxes_of(simulation_of(folder, scene));
  scene.leaf =
      "type = \"map\"\nfile = \"halves.pgm\"\nmaterials = [\"hole\", \"green\"]\n"
      "[materials.hole]\ntype = \"transparent\"\ntransmittance = 1.0\n[materials.green]\n" +
      bilambertian("0.4", "0.3");
  scene.mesh = "leaf.obj";
  const Simulation simulation = simulation_of(folder, scene);
  const FluxResult mapped = fluxes_of(simulation, {}, 2);
  for (const Flux which : {Flux::reflected, Flux::transmitted, Flux::transmitted_first,
                           Flux::transmitted_direct, Flux::absorbed_canopy, Flux::absorbed_ground}) {
    const Value a = flux(half, which), b = flux(mapped, which);
    EXPECT_LT(std::abs(a.value - b.value), 4.5 * std::hypot(a.error, b.error) + 1e-9)
        << name_of(which) << " " << a.value << " and " << b.value;
  }
  for (std::size_t m = 0; m < simulation.materials.size(); ++m) {
    const std::size_t row = mapped.row(Flux::absorbed_material, static_cast<std::uint32_t>(m));
    const double absorbed = mapped.fraction[0].value[row];
    const std::string& name = simulation.materials[m].name;
    if (name == "soil") continue;
    EXPECT_NEAR(absorbed, name == "green" ? flux(mapped, Flux::absorbed_canopy).value : 0.0, 1e-9) << name;
  }
  // And as the reverse mode sees it.
  scene.sky.clear();
  scene.sampling = "samples = 131072";
  const Value forward = flux(fluxes_of(simulation_of(folder, scene), {}, 3), Flux::reflected);
  scene.sensor = "name = \"up\"\ntype = \"albedo\"\n";
  scene.sampling = "samples = 131072";
  const SensorResult reverse = sensor_result(folder, scene, 4);
  const double scale = pi / simulation.light.direct_irradiance(1)[0];
  EXPECT_LT(std::abs(forward.value - reverse.radiance[0].value[0] * scale),
            4 * std::hypot(forward.error, reverse.radiance[0].standard_error[0] * scale))
      << forward.value << " and " << reverse.radiance[0].value[0] * scale;
}

TEST(Fluxes, StopWhenTheirTimeIsOver) {
  const TemporaryFolder folder;
  SceneText scene = canopy(folder);
  scene.sun = sun_at(30, 0);
  scene.sensor = "name = \"energy\"\ntype = \"flux\"\n";
  scene.sampling = "target_se = 1e-9\nmax_samples = 100_000_000_000\nmax_seconds = 0.2";
  const Result result = simulate(simulation_of(folder, scene), 1);
  EXPECT_EQ(result.stopped_by, "max_seconds");
  ASSERT_EQ(result.fluxes.size(), 1u);
  EXPECT_EQ(result.fluxes[0]->stopped_by, "max_seconds");
  expect_energy_to_close(*result.fluxes[0], 0.2);
}

TEST(Fluxes, BumpsAreRefused) {
  const TemporaryFolder folder;
  folder.write("steps.pgm", "P2\n2 1\n1\n0 1\n");
  SceneText scene = canopy(folder);
  scene.leaf += "bump = { file = \"steps.pgm\", height_m = 0.01 }\n";
  scene.sun = sun_at(30, 0);
  scene.sampling = "samples = 64";
  BPMS_EXPECT_ERROR(fluxes_of(simulation_of(folder, scene)), ErrorKind::bad_input, "'leaf' has a bump");
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
