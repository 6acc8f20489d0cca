// RAMI HET01, 750 000 discs: seconds and MiB to build, and seconds until the BRF of all 76 views is known to
// a relative standard error, with one and with two threads. Errors fall with the square root of the paths, so
// the time to 0.1 % is that to E % times (E / 0.1)^2.
//   bench_het01 DATA_FOLDER [E]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"
#include "simulate/simulate.h"

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "bench_het01 DATA_FOLDER [RELATIVE_STANDARD_ERROR_IN_PERCENT]\n");
    return 2;
  }
  using namespace bpms;
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  const double target_percent = argc > 2 ? std::atof(argv[2]) : 0.4;
  set_quiet(true);
  // The disc lists are looked for beside the scene.
  const std::string beside = std::string(argv[1]) + "/rami/het01/scene.toml";
  Simulation simulation = parse_simulation(beside, read_text(BPMS_SOURCE_DIR "/examples/het01/scene.toml"));
  set_target_se(simulation.sampling, fmt::format("{}%", target_percent), {"the benchmark"});
  const Clock::time_point start = Clock::now();
  const Intersector intersector(simulation.scene);
  fmt::print("build {:.2f} s, {:.0f} MiB\n", since(start),
             static_cast<double>(intersector.memory_bytes()) / 1048576);
  for (const int count : {1, 2}) {
    set_threads(count);
    const Clock::time_point begun = Clock::now();
    const Result result = simulate(simulation, intersector, 1);
    const double seconds = since(begun);
    const Estimates& total = result.sensors[0].radiance[0];
    double worst = 0;
    for (std::size_t view = 0; view < total.value.size(); ++view)
      worst = std::max(worst, total.standard_error[view] / total.value[view]);
    const double factor = target_percent / 0.1;
    fmt::print(
        "{} thread(s): {:.1f} s to {:.3f} % at worst, {} paths, {:.2f} M rays/s; to 0.1 %: {:.0f} s{}\n",
        count, seconds, 100 * worst, result.samples, static_cast<double>(result.rays) / seconds / 1e6,
        seconds * factor * factor, factor == 1 ? "" : " (scaled)");
  }
}
