// Images: many views with few paths each.
#include "simulate/transport/rounds.h"

namespace bpms {

// Images: a few pixels at a time, from start to finish.
template <class Tally>
void run_pixels(Run& run, const Sensor& sensor, const ViewStart<Tally>& start, SensorResult& result) {
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
    RoundClock::time_point end = run.deadline;
    const double still = std::max(1.0, static_cast<double>(tiles - started++) / threads());
    if (end != RoundClock::time_point::max())
      end = RoundClock::now() +
            std::chrono::duration_cast<RoundClock::duration>((end - RoundClock::now()) / still);
    Pace pace(end);
    std::vector<ViewState<Tally>> pixels;
    std::vector<ViewState<Tally>*> active;
    for (std::size_t view = tile * together; view < std::min(sensor.views(), (tile + 1) * together); ++view) {
      pixels.emplace_back(*run.stage, start.sources, start.empty, view);
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

template void run_pixels(Run&, const Sensor&, const ViewStart<LaneTally>&, SensorResult&);
template void run_pixels(Run&, const Sensor&, const ViewStart<InteractionTally>&, SensorResult&);
template void run_pixels(Run&, const Sensor&, const ViewStart<SpectrumTally>&, SensorResult&);
template void run_pixels(Run&, const Sensor&, const ViewStart<SampledTally>&, SensorResult&);

}  // namespace bpms
