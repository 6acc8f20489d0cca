// The rounds of a view: its batches grow together, a round at a time, by what the target, the limits and the
// time that is left ask for. What directions (directions.cpp) and images (images.cpp) share.
#pragma once
#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>

#include "core/interrupt.h"
#include "core/parallel.h"
#include "simulate/transport/estimate.h"
#include "simulate/transport/interaction_histogram.h"
#include "simulate/transport/interactions.h"
#include "simulate/transport/lane_tally.h"
#include "simulate/transport/sampled_tally.h"
#include "simulate/transport/schedule.h"
#include "simulate/transport/spectrum_tally.h"
#include "simulate/transport/wave.h"

namespace bpms {

using RoundClock = std::chrono::steady_clock;

inline constexpr std::uint64_t first_round = 32;  // paths a batch
// Of the first hits of parallel rays: a grid costs as much as some 3e5 of them through the intersector.
inline constexpr std::uint64_t worth_a_grid = 400'000, most_view_grid_bytes = std::uint64_t{1} << 27;

// Paths a batch that are traced together: enough to make neighbours, pieces enough for the threads.
template <class Tally>
std::uint64_t piece_size(std::uint64_t paths, const Optics& optics) {
  return std::min<std::uint64_t>(std::clamp<std::uint64_t>(paths / 2, 128, 8192),
                                 Tally::largest_piece(optics));
}

// What a batch starts from, and the light that its sums are multiplied by.
template <class Tally>
struct ViewStart {
  Tally empty;
  Sources sources;
};

template <class Tally>
class ViewState {
 public:
  ViewState(const Stage& stage, const Sources& sources, const Tally& empty, std::size_t index)
      : stage_(&stage), sources_(&sources), view(index) {
    empty_.assign(batches, empty);
    tallies = empty_;
  }

  // A round of paths done ... goal is traced in pieces, in any order, and merged in theirs.
  std::size_t pieces() const { return goal == done ? 0 : (goal - done + piece() - 1) / piece(); }
  std::uint64_t piece() const { return piece_size<Tally>(goal - done, stage_->optics); }
  void start_round() { pieces_.assign(pieces(), {}); }
  void trace_piece(const Run& run, const Sensor& sensor, std::size_t number) {
    if (interrupted()) return;
    pieces_[number] = empty_;
    const std::uint64_t size = piece(), first = done + number * size;
    Wave<Tally> wave(*stage_, view_rays.get());
    wave.add(sensor, view, key(run), first, std::min(goal, first + size), pieces_[number]);
    wave.run();
  }
  void merge_round() {
    for (const auto& part : pieces_)
      for (std::size_t batch = 0; batch < part.size(); ++batch) tallies[batch].merge(part[batch]);
    pieces_.clear();
  }
  ViewKey key(const Run& run) const { return {run.seed, run.sensor_index, view}; }

  bool has_all_batches() const {
    return std::all_of(tallies.begin(), tallies.end(), [](const Tally& t) { return t.counts.paths > 0; });
  }
  std::vector<BatchMeans> means() const {
    std::vector<BatchMeans> out(batches);
    for (std::size_t b = 0; b < batches; ++b) tallies[b].means(out[b]);
    return out;
  }
  // After a round: sets the next goal, or leaves it where it is when the view is finished. `affordable`:
  // paths a batch that there is time for.
  void plan(double affordable, std::atomic<bool>& out_of_time, std::atomic<bool>& out_of_samples) {
    const Simulation& simulation = *stage_->simulation;
    done = goal;
    const double ratio = simulation.sampling.target_se > 0 ? reached(means(), *sources_) : 0;
    goal = next_size(simulation.sampling, done, ratio);
    if (goal == done && simulation.sampling.target_se > 0 && ratio < 1) out_of_samples = true;
    if (static_cast<double>(goal - done) <= affordable) return;
    constexpr std::uint64_t least_part = 8;  // of what is done: less is not worth a round
    goal = done + static_cast<std::uint64_t>(affordable);
    if (goal - done >= done / least_part && goal > done) return;
    goal = done;
    out_of_time = true;
  }
  void prepare(const Sensor& sensor) {
    const std::uint64_t planned = std::max(goal * batches, stage_->simulation->sampling.samples);
    if (asked_for_rays_ || planned < worth_a_grid) return;
    asked_for_rays_ = true;
    if (const auto towards = sensor.parallel(view))
      view_rays =
          stage_->intersector->parallel_rays(stage_->simulation->scene, *towards, most_view_grid_bytes);
  }
  void finish(SensorResult& result) const {
    std::vector<const ViewCounts*> counts;
    for (const Tally& tally : tallies) counts.push_back(&tally.counts);
    write_light(means(), *sources_, view, result);
    write_fractions(counts, view, result);
    if constexpr (std::is_same_v<Tally, InteractionTally>)
      if (!result.histograms.empty()) result.histograms[view] = interaction_histogram(tallies);
  }

 private:
  const Stage* stage_;
  const Sources* sources_;
  bool asked_for_rays_ = false;
  std::vector<Tally> empty_;
  std::vector<std::vector<Tally>>
      pieces_;  // by piece: one tally a batch; none where an interrupt came before

 public:
  std::size_t view;
  std::uint64_t done = 0, goal = 0;  // paths a batch
  std::vector<Tally> tallies;
  std::shared_ptr<const ParallelRays> view_rays;  // made when there are paths enough to pay for it
};

// How many paths a view and batch there is time for, by the pace of the round that is over.
class Pace {
 public:
  explicit Pace(RoundClock::time_point deadline) : deadline_(deadline) {}
  template <class Tally>
  void start_round(const std::vector<ViewState<Tally>*>& active) {
    began_ = RoundClock::now();
    paths_ = 0;
    for (const ViewState<Tally>* view : active) paths_ += static_cast<double>(view->goal - view->done);
    views_ = static_cast<double>(active.size());
  }
  double affordable() const {
    if (deadline_ == RoundClock::time_point::max()) return std::numeric_limits<double>::infinity();
    const auto seconds = [](RoundClock::duration d) { return std::chrono::duration<double>(d).count(); };
    const RoundClock::time_point now = RoundClock::now();
    const double spent = std::max(1e-9, seconds(now - began_));
    return std::max(0.0, seconds(deadline_ - now)) * paths_ / spent / views_;
  }

 private:
  RoundClock::time_point deadline_, began_;
  double paths_ = 0, views_ = 1;
};

template <class Tally>
void collect(const ViewState<Tally>& state, SensorResult& result, std::atomic<std::uint64_t>& rays,
             std::atomic<std::uint64_t>& lost) {
  for (const Tally& tally : state.tallies) {
    rays += tally.counts.rays;
    lost += tally.counts.lost;
  }
  if (state.has_all_batches()) state.finish(result);
}

// All views of a sensor of directions, or all pixels of an image.
template <class Tally>
void run_directions(Run& run, const Sensor& sensor, const ViewStart<Tally>& start, SensorResult& result);
template <class Tally>
void run_pixels(Run& run, const Sensor& sensor, const ViewStart<Tally>& start, SensorResult& result);

}  // namespace bpms
