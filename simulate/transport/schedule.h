// How much to trace where. A view's paths come in `batches` independent batches that grow together, round by
// round, until the target is met or a limit stops them. Each (view, batch) adds up by itself and views decide
// for themselves, so results have the same bits on any number of threads.
#pragma once
#include <chrono>

#include "core/progress.h"
#include "simulate/transport/stage.h"

namespace bpms {

struct Run {
  const Stage* stage;
  std::uint64_t seed = 1;
  std::uint32_t sensor_index = 0;
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  bool out_of_time = false;     // set when the deadline stopped a view
  bool out_of_samples = false;  // set when max_samples did
  Progress* progress = nullptr;
};

// Paths a batch, next round: from `now` (0: none yet), and how far the target is (see `reached`).
std::uint64_t next_size(const Sampling& sampling, std::uint64_t now, double reached);

// What the result of a sensor takes, in bytes; before it is made.
std::uint64_t result_bytes(const Stage& stage, const Sensor& sensor);

// Estimates of all views of a sensor; views that an interrupt left out have samples = 0.
SensorResult run_sensor(Run& run, const Sensor& sensor);

}  // namespace bpms
