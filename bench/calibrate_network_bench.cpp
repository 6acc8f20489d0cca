// The cost of a network against its frames: bench_calibrate_network [cameras] [frames...]; a 9x6 board held
// before a rig that stands, in 640x480 images. Everything that `bpms calibrate` does after the corners: first
// guess, search for outliers, least squares, covariances iid and by frame, half sets.
#include <fmt/core.h>

#include <vector>

#include "bench/process_status.h"
#include "calibrate/adjustment/synthetic_network.h"
#include "calibrate/calibrate.h"
#include "core/text.h"

int main(int argc, char** argv) {
  using namespace bpms;
  try {
    const auto number = [&](int i) { return static_cast<int>(parse_integer(argv[i]).value_or(0)); };
    const int cameras = argc > 1 ? number(1) : 4;
    std::vector<int> frames;
    for (int i = 2; i < argc; ++i) frames.push_back(number(i));
    if (frames.empty()) frames = {125, 250, 500, 1000};
    Target board;
    board.columns = 9, board.rows = 6, board.square_m = 0.025;
    fmt::print("{:>7} {:>8} {:>8} {:>12} {:>12} {:>10} {:>12}\n", "frames", "corners", "solve s",
               "uncertainty s", "ms a frame", "peak MiB", "baseline mm");
    for (const int count : frames) {
      const NetworkMeasurement m =
          measured(synthetic_network({.cameras = cameras, .frames = count, .seed = 5}), 0.15, 1);
      const Calibration c = calibrate(m.observations(), board);
      fmt::print("{:7} {:8} {:8.2f} {:12.2f} {:12.2f} {:10.0f} {:12.4f}\n", count, c.corners_used,
                 c.solve_seconds, c.uncertainty_seconds,
                 1e3 * (c.solve_seconds + c.uncertainty_seconds) / count, status_mib("VmHWM"),
                 1e3 * c.pairs.at(0).baseline_m);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
  return 0;
}
