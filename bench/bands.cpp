// Time of a run with 2 101 bands over that of the same paths with one band (homogeneous disc canopy, nadir,
// one thread, processor time).
//   bench_bands DATA_FOLDER [PATHS]
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>

#include "bench/homogeneous_scene.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/units.h"

namespace {

using namespace bpms;

// From red to near infrared and back, so that bands differ as those of leaves do; a single band is the NIR.
void set_bands(Simulation& simulation, std::size_t count) {
  const auto spread = [count](std::vector<double>& spectrum) {
    const double red = spectrum[0], infrared = spectrum[1];
    spectrum.assign(count, infrared);
    for (std::size_t band = 0; count > 1 && band < count; ++band) {
      const double at = std::sin(3 * pi * static_cast<double>(band) / static_cast<double>(count - 1));
      spectrum[band] = red + (infrared - red) * at * at;
    }
  };
  for (Material& material : simulation.materials) {
    for (auto& reflectance : material.reflectance) spread(reflectance);
    spread(material.transmittance);
  }
  simulation.bands.wavelengths_nm.resize(count);
  for (std::size_t band = 0; band < count; ++band)
    simulation.bands.wavelengths_nm[band] = 400 + static_cast<double>(band);
  auto& irradiance = simulation.light.suns.front().irradiance;
  irradiance.assign(count, irradiance[0]);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "bench_bands DATA_FOLDER [PATHS]\n");
    return 2;
  }
  set_threads(1);
  set_quiet(true);
  double one_band = 0;
  for (const std::size_t count : {1u, 2101u}) {
    Simulation simulation = bench::homogeneous(argv[1], {0.0});
    simulation.sampling.samples = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1u << 20;
    set_bands(simulation, count);
    const Intersector intersector(simulation.scene);
    double least = 1e30;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const std::clock_t start = std::clock();
      const Result result = simulate(simulation, intersector, 1);
      least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    if (count == 1) one_band = least;
    fmt::print("{} band(s): {:.2f} s, ratio {:.2f}\n", count, least, least / one_band);
  }
}
