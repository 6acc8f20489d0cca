#include "simulate/transport/schedule.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "core/interrupt.h"
#include "core/parallel.h"
#include "simulate/transport/estimate.h"
#include "simulate/transport/interaction_histogram.h"
#include "simulate/transport/interactions.h"
#include "simulate/transport/lane_tally.h"
#include "simulate/transport/sampled_tally.h"
#include "simulate/transport/spectrum_tally.h"
#include "simulate/transport/wave.h"

namespace bpms {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t first_round = 32;  // paths a batch
// Of the first hits of parallel rays: a grid costs as much as some 3e5 of them through the intersector.
constexpr std::uint64_t worth_a_grid = 400'000, most_view_grid_bytes = std::uint64_t{1} << 27;

// Rounded up to four steps an octave, which keeps Sobol points balanced.
std::uint64_t round_up(double paths) {
  auto n = static_cast<std::uint64_t>(std::ceil(paths));
  const std::uint64_t step = std::max<std::uint64_t>(1, std::bit_floor(n) / 4);
  return (n + step - 1) / step * step;
}

// Paths a batch that are traced together: enough to make neighbours, pieces enough for the threads.
template <class Tally>
std::uint64_t piece_size(std::uint64_t paths, const Optics& optics) {
  return std::min<std::uint64_t>(std::clamp<std::uint64_t>(paths / 2, 128, 8192),
                                 Tally::largest_piece(optics));
}

// What a batch starts from, and the light that its sums are multiplied by.
template <class Tally>
struct Sums {
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
  explicit Pace(Clock::time_point deadline) : deadline_(deadline) {}
  template <class Tally>
  void start_round(const std::vector<ViewState<Tally>*>& active) {
    began_ = Clock::now();
    paths_ = 0;
    for (const ViewState<Tally>* view : active) paths_ += static_cast<double>(view->goal - view->done);
    views_ = static_cast<double>(active.size());
  }
  double affordable() const {
    if (deadline_ == Clock::time_point::max()) return std::numeric_limits<double>::infinity();
    const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
    const Clock::time_point now = Clock::now();
    const double spent = std::max(1e-9, seconds(now - began_));
    return std::max(0.0, seconds(deadline_ - now)) * paths_ / spent / views_;
  }

 private:
  Clock::time_point deadline_, began_;
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

// Directions: all batches of a group of views side by side.
template <class Tally>
void run_group(Run& run, const Sensor& sensor, std::size_t first, std::size_t last, const Sums<Tally>& sums,
               SensorResult& result) {
  const Sampling& sampling = run.stage->simulation->sampling;
  std::vector<ViewState<Tally>> views;
  for (std::size_t view = first; view < last; ++view) {
    views.emplace_back(*run.stage, sums.sources, sums.empty, view);
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

// Images: a few pixels at a time, from start to finish.
template <class Tally>
void run_pixels(Run& run, const Sensor& sensor, const Sums<Tally>& sums, SensorResult& result) {
  constexpr std::size_t together = 16;
  const std::size_t largest_wave = std::min<std::size_t>(1 << 18, Tally::largest_piece(run.stage->optics));
  const Sampling& sampling = run.stage->simulation->sampling;
  std::atomic<bool> out_of_time{false}, out_of_samples{false};
  std::atomic<std::uint64_t> rays{0}, lost{0};
  const std::size_t tiles = (sensor.views() + together - 1) / together;
  // The pixels of an orthographic image share a direction.
  const auto towards = sensor.parallel(0);
  std::unique_ptr<const ParallelRays> grid;
  if (towards &&
      sensor.views() * std::max<std::uint64_t>(sampling.samples, batches * first_round) >= worth_a_grid)
    grid =
        run.stage->intersector->parallel_rays(run.stage->simulation->scene, *towards, most_view_grid_bytes);
  std::atomic<std::size_t> started{0};
  parallel_for(tiles, [&](std::size_t tile) {
    // Each tile gets its share of the time that is left.
    Clock::time_point end = run.deadline;
    const double still = std::max(1.0, static_cast<double>(tiles - started++) / threads());
    if (end != Clock::time_point::max())
      end = Clock::now() + std::chrono::duration_cast<Clock::duration>((end - Clock::now()) / still);
    Pace pace(end);
    std::vector<ViewState<Tally>> pixels;
    std::vector<ViewState<Tally>*> active;
    for (std::size_t view = tile * together; view < std::min(sensor.views(), (tile + 1) * together); ++view) {
      pixels.emplace_back(*run.stage, sums.sources, sums.empty, view);
      if (sensor.covers(view)) pixels.back().goal = next_size(sampling, 0, 0);
    }
    for (auto& pixel : pixels)
      if (pixel.goal > 0) active.push_back(&pixel);
    Wave<Tally> wave(*run.stage, grid.get());
    while (!active.empty() && !interrupted()) {
      pace.start_round(active);
      for (ViewState<Tally>* pixel : active) {
        const std::uint64_t piece = piece_size<Tally>(pixel->goal, run.stage->optics);
        for (std::uint64_t from = pixel->done; from < pixel->goal; from += piece) {
          const std::uint64_t to = std::min(pixel->goal, from + piece);
          wave.add(sensor, pixel->view, pixel->key(run), from, to, pixel->tallies);
          if (wave.size() > largest_wave) wave.run();
        }
        run.progress->add((pixel->goal - pixel->done) * batches);
      }
      wave.run();
      const double affordable = pace.affordable();
      for (ViewState<Tally>* pixel : active) pixel->plan(affordable, out_of_time, out_of_samples);
      std::erase_if(active, [](const ViewState<Tally>* pixel) { return pixel->goal == pixel->done; });
    }
    for (const auto& pixel : pixels) collect(pixel, result, rays, lost);
  });
  result.rays += rays;
  result.lost += lost;
  run.out_of_time = run.out_of_time || out_of_time;
  run.out_of_samples = run.out_of_samples || out_of_samples;
}

template <class Tally>
void run_views(Run& run, const Sensor& sensor, const Sums<Tally>& sums, SensorResult& result) {
  if (sensor.is_image()) return run_pixels<Tally>(run, sensor, sums, result);
  // Groups bound the memory of tallies; each gets its share of the time.
  const bool large =
      run.stage->optics.carriage == Carriage::counted || run.stage->optics.carriage == Carriage::spectrum;
  const std::size_t group = large ? std::max<std::size_t>(1, static_cast<std::size_t>(threads()) / 8) : 8;
  const Clock::time_point start = Clock::now(), end = run.deadline;
  for (std::size_t first = 0; first < sensor.views() && !interrupted(); first += group) {
    const std::size_t last = std::min(sensor.views(), first + group);
    if (end != Clock::time_point::max())
      run.deadline = start + (end - start) / static_cast<long>(sensor.views()) * static_cast<long>(last);
    run_group<Tally>(run, sensor, first, last, sums, result);
  }
  run.deadline = end;
}

void drop_empty_orders(SensorResult& result) {
  int highest = 1;
  for (std::size_t p = 0; p < result.parts.size(); ++p) {
    const auto& values = result.radiance[p].value;
    if (std::any_of(values.begin(), values.end(), [](double v) { return v != 0; }))
      highest = std::max(highest, result.parts[p].order);
  }
  for (std::size_t p = result.parts.size(); p-- > 0;) {
    if (result.parts[p].order <= highest) continue;
    result.parts.erase(result.parts.begin() + static_cast<std::ptrdiff_t>(p));
    result.radiance.erase(result.radiance.begin() + static_cast<std::ptrdiff_t>(p));
  }
}

}  // namespace

std::uint64_t next_size(const Sampling& sampling, std::uint64_t now, double reached) {
  if (sampling.samples > 0) {  // the whole at once would leave nothing to keep at an interrupt
    const std::uint64_t all = std::bit_ceil((sampling.samples + batches - 1) / batches);
    return std::min(all, now == 0 ? first_round : now * 4);
  }
  const std::uint64_t most = std::max<std::uint64_t>(1, sampling.max_samples / batches);
  if (now == 0) return std::min(most, first_round);
  if (reached >= 1) return now;
  constexpr double margin = 1.05;  // the standard error is itself uncertain
  const double wanted = static_cast<double>(now) * margin / (reached * reached);
  const double bounded = std::clamp(wanted, 1.25 * static_cast<double>(now), 16.0 * static_cast<double>(now));
  return std::min(most, round_up(bounded));
}

SensorResult run_sensor(Run& run, const Sensor& sensor) {
  const Simulation& simulation = *run.stage->simulation;
  const Optics& optics = run.stage->optics;
  const std::size_t bands = simulation.bands.written(), views = sensor.views(),
                    suns = simulation.light.suns.size(), by_material = suns * simulation.materials.size();
  constexpr int many_orders = 64, few_orders = 10;
  const bool lean = optics.carriage == Carriage::carried || optics.carriage == Carriage::sampled;
  Rows rows{suns, simulation.sampling.orders > 0 ? simulation.sampling.orders
                  : lean                         ? many_orders
                                                 : few_orders};
  if (simulation.sampling.max_order > 0) rows.orders = std::min(rows.orders, simulation.sampling.max_order);
  SensorResult out;
  out.sensor = &sensor;
  out.parts = parts_of(simulation.light, sensor.is_image() ? 0 : rows.orders);
  if (sensor.is_image()) rows.orders = 1;
  out.radiance.resize(out.parts.size());
  for (Estimates& part : out.radiance) part.resize(views * bands);
  out.gap.resize(views);
  for (Estimates* fractions : {&out.sunlit, &out.shaded, &out.lit_behind})
    fractions->resize(views * by_material);
  out.sunlit_ground.resize(views * suns);
  out.samples.assign(views, 0);
  if (suns > 0 && simulation.light.sky) out.direct_diffuse_covariance.assign(views * bands, 0.0);
  if (simulation.sampling.keep_interactions && optics.carriage == Carriage::counted && !sensor.is_image())
    out.histograms.resize(views);
  const Sources sources(simulation);
  switch (optics.carriage) {
    case Carriage::carried:
      run_views<LaneTally>(run, sensor, {LaneTally(optics, rows), sources}, out);
      break;
    case Carriage::counted:
      run_views<InteractionTally>(run, sensor, {InteractionTally(optics, rows), sources}, out);
      break;
    case Carriage::spectrum:
      run_views<SpectrumTally>(run, sensor, {SpectrumTally(optics, rows), sources}, out);
      break;
    case Carriage::sampled:
      run_views<SampledTally>(run, sensor, {SampledTally(optics, rows, simulation), sources}, out);
      break;
  }
  drop_empty_orders(out);
  write_truncation(simulation.sampling, bands, out);
  return out;
}

}  // namespace bpms
