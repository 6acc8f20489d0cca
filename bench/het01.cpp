// RAMI HET01, 750 000 discs: seconds until the BRF of all 76 views is known to a relative standard error, by
// shared photon paths (one and two threads), beside a plain tracer over the same scene in the same run and,
// if asked for, the reverse mode. Errors fall with the square root of the paths: times to 0.1 % are those to
// E times (E / 0.1 %)^2. The plain tracer's time is scaled from six views; its build is not counted, ours is.
//   bench_het01 DATA_FOLDER [E_PERCENT [PLAIN_PATHS_A_VIEW [REVERSE_E_PERCENT]]]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>

#include "bench/plain_tracer.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"
#include "simulate/forward/shared_views.h"
#include "simulate/simulate.h"

namespace {

using namespace bpms;
using Clock = std::chrono::steady_clock;

constexpr double aim_percent = 0.1;

struct Stopwatch {
  Clock::time_point wall = Clock::now();
  std::clock_t processor = std::clock();
  double wall_s() const { return std::chrono::duration<double>(Clock::now() - wall).count(); }
  double processor_s() const { return static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC; }
};

// Processor seconds of the plain tracer to 0.1 % in every view.
double plain_seconds(const Simulation& simulation, std::uint64_t paths) {
  const bench::PlainTracer tracer(simulation);
  const Sensor& sensor = *simulation.sensors[0];
  double sum = 0;
  int count = 0;
  for (std::size_t view = 0; view < sensor.views(); view += 15, ++count) {
    const bench::PlainResult one = tracer.trace(sensor.vza_deg(view), paths, view + 1);
    const double target = aim_percent / 100 * one.mean[0];
    sum += one.variance[0] / (target * target) * one.seconds / static_cast<double>(paths);
  }
  return sum / count * static_cast<double>(sensor.views());
}

double worst_percent(const SensorResult& result) {
  const Estimates& total = result.radiance[0];
  double worst = 0;
  for (std::size_t view = 0; view < total.value.size(); ++view)
    worst = std::max(worst, total.standard_error[view] / total.value[view]);
  return 100 * worst;
}

void print(const char* what, int threads, const Stopwatch& watch, double worst, std::uint64_t rays,
           double target) {
  const double factor = target * target / (aim_percent * aim_percent);
  fmt::print(
      "{}, {} thread(s): {:.1f} s ({:.1f} of the processor) to {:.3f} % at worst, {:.1f} M rays; to 0.1 %: "
      "{:.0f} s ({:.0f})\n",
      what, threads, watch.wall_s(), watch.processor_s(), worst, static_cast<double>(rays) / 1e6,
      watch.wall_s() * factor, watch.processor_s() * factor);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "bench_het01 DATA_FOLDER [E_PERCENT [PLAIN_PATHS_A_VIEW [REVERSE_E_PERCENT]]]\n");
    return 2;
  }
  const double target_percent = argc > 2 ? std::atof(argv[2]) : 0.2;
  const std::uint64_t plain_paths = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 100'000;
  const double reverse_percent = argc > 4 ? std::atof(argv[4]) : 0;
  set_quiet(true);
  // The disc lists are looked for beside the scene.
  const std::string beside = std::string(argv[1]) + "/rami/het01/scene.toml";
  Simulation simulation = parse_simulation(beside, read_text(BPMS_SOURCE_DIR "/examples/het01/scene.toml"));
  const Stopwatch build;
  const Intersector intersector(simulation.scene);
  fmt::print("build {:.2f} s, {:.0f} MiB\n", build.wall_s(),
             static_cast<double>(intersector.memory_bytes()) / 1048576);
  const double plain_before = plain_seconds(simulation, plain_paths);
  double ours = 0;
  for (const int count : {1, 2}) {
    set_threads(count);
    set_target_se(simulation.sampling, fmt::format("{}%", target_percent), {"the benchmark"});
    const Stopwatch watch;
    const SharedViews shared = trace_shared_views(simulation, intersector, *simulation.sensors[0], 1, 0);
    print("shared paths", count, watch, worst_percent(shared.result), shared.result.rays, target_percent);
    if (count == 1)
      ours = watch.processor_s() * target_percent * target_percent / (aim_percent * aim_percent);
    if (reverse_percent <= 0) continue;
    set_target_se(simulation.sampling, fmt::format("{}%", reverse_percent), {"the benchmark"});
    const Stopwatch reverse;
    const Result result = simulate(simulation, intersector, 1);
    print("reverse", count, reverse, worst_percent(result.sensors[0]), result.rays, reverse_percent);
  }
  const double plain = 0.5 * (plain_before + plain_seconds(simulation, plain_paths));
  fmt::print(
      "plain tracer, 1 thread, 76 views to 0.1 %: {:.0f} s of the processor; ratio to shared paths {:.2f}\n",
      plain, plain / ours);
}
