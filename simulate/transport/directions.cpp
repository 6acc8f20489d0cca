// Sensors of directions: few views with many paths each.
#include "simulate/transport/rounds.h"

namespace bpms {
namespace {

// Directions: all batches of a group of views side by side.
template <class Tally>
void run_group(Run& run, const Sensor& sensor, std::size_t first, std::size_t last,
               const ViewStart<Tally>& start, SensorResult& result) {
  const Sampling& sampling = run.stage->simulation->sampling;
  std::vector<ViewState<Tally>> views;
  for (std::size_t view = first; view < last; ++view) {
    views.emplace_back(*run.stage, start.sources, start.empty, view);
    views.back().goal = next_size(sampling, 0, 0);
  }
  std::atomic<bool> out_of_time{false}, out_of_samples{false};
  std::atomic<std::uint64_t> rays{0}, lost{0};
  std::vector<ViewState<Tally>*> active;
  for (auto& state : views) active.push_back(&state);
  Pace pace(run.deadline);
  while (!active.empty() && !interrupted()) {
    pace.start_round(active);
    parallel_for(active.size(), [&](std::size_t i) { active[i]->prepare(sensor); });
    std::vector<std::pair<ViewState<Tally>*, std::size_t>> work;
    for (ViewState<Tally>* state : active) {
      state->start_round();
      for (std::size_t piece = 0; piece < state->pieces(); ++piece) work.emplace_back(state, piece);
    }
    parallel_for(work.size(), [&](std::size_t i) {
      const auto& [state, piece] = work[i];
      state->trace_piece(run, sensor, piece);
      run.progress->add(std::min(state->goal - state->done, state->piece()) * batches);
    });
    parallel_for(active.size(), [&](std::size_t i) { active[i]->merge_round(); });
    if (interrupted()) break;
    const double affordable = pace.affordable();
    parallel_for(active.size(),
                 [&](std::size_t i) { active[i]->plan(affordable, out_of_time, out_of_samples); });
    std::erase_if(active, [](const ViewState<Tally>* state) { return state->goal == state->done; });
  }
  parallel_for(views.size(), [&](std::size_t i) { collect(views[i], result, rays, lost); });
  result.rays += rays;
  result.lost += lost;
  run.out_of_time = run.out_of_time || out_of_time;
  run.out_of_samples = run.out_of_samples || out_of_samples;
}

}  // namespace

template <class Tally>
void run_directions(Run& run, const Sensor& sensor, const ViewStart<Tally>& start, SensorResult& result) {
  // Groups bound the memory of tallies; each gets its share of the time.
  const bool large =
      run.stage->optics.carriage == Carriage::counted || run.stage->optics.carriage == Carriage::spectrum;
  const std::size_t group = large ? std::max<std::size_t>(1, static_cast<std::size_t>(threads()) / 8) : 8;
  const RoundClock::time_point now = RoundClock::now(), end = run.deadline;
  for (std::size_t first = 0; first < sensor.views() && !interrupted(); first += group) {
    const std::size_t last = std::min(sensor.views(), first + group);
    if (end != RoundClock::time_point::max())
      run.deadline = now + (end - now) / static_cast<long>(sensor.views()) * static_cast<long>(last);
    run_group<Tally>(run, sensor, first, last, start, result);
  }
  run.deadline = end;
}

template void run_directions(Run&, const Sensor&, const ViewStart<LaneTally>&, SensorResult&);
template void run_directions(Run&, const Sensor&, const ViewStart<InteractionTally>&, SensorResult&);
template void run_directions(Run&, const Sensor&, const ViewStart<SpectrumTally>&, SensorResult&);
template void run_directions(Run&, const Sensor&, const ViewStart<SampledTally>&, SensorResult&);

}  // namespace bpms
