// Efficiency of the radiative transfer: variance x seconds at nadir on the homogeneous disc canopy, both
// bands carried, one thread (processor time), beside a plain tracer on the same scene in the same run. Prints
// ratios, which hold on noisy machines.
//   bench_radiative_transfer DATA_FOLDER [PATHS [REPEATS]]
#include <fmt/core.h>

#include <cstdlib>
#include <ctime>

#include "bench/homogeneous_scene.h"
#include "bench/plain_tracer.h"
#include "core/parallel.h"
#include "core/progress.h"

namespace {

// Of efficiencies: the estimate of a variance from 32 batches is off by 18 %, and so is each value's.
double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "bench_radiative_transfer DATA_FOLDER [PATHS [REPEATS]]\n");
    return 2;
  }
  using namespace bpms;
  set_threads(1);
  set_quiet(true);
  const std::uint64_t paths = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 131072;
  const int repeats = argc > 3 ? std::atoi(argv[3]) : 5;
  Simulation simulation = bench::homogeneous(argv[1], {0.0});
  simulation.sampling.samples = paths;
  const Intersector intersector(simulation.scene);
  std::vector<double> plain, ours;
  for (int r = 0; r < repeats; ++r) {
    const auto seed = static_cast<std::uint64_t>(r + 1);
    const bench::PlainResult yardstick = bench::trace_plainly(simulation, 0.0, paths, seed);
    const std::clock_t start = std::clock();
    const Result result = simulate(simulation, intersector, seed);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const Estimates& total = result.sensors[0].radiance[0];
    plain.push_back(yardstick.variance[1] / static_cast<double>(paths) * yardstick.seconds);
    ours.push_back(total.standard_error[1] * total.standard_error[1] * seconds);
    fmt::print(
        "plain {:.6f} +- {:.6f} in {:.2f} s   bpms {:.6f} +- {:.6f} in {:.2f} s ({} paths, {:.2f} M "
        "rays/s)\n",
        yardstick.mean[1], std::sqrt(yardstick.variance[1] / static_cast<double>(paths)), yardstick.seconds,
        total.value[1], total.standard_error[1], seconds, result.samples,
        static_cast<double>(result.rays) / seconds / 1e6);
  }
  fmt::print("NIR nadir, variance x seconds: plain {:.2e}, bpms {:.2e}, ratio {:.2f} (means of {} runs)\n",
             mean(plain), mean(ours), mean(plain) / mean(ours), repeats);
}
