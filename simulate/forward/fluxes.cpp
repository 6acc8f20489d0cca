// Batches of photons, round by round, until the fluxes are known well enough. A batch belongs to one thread
// at a time and adds up in the order of its samples, so results have the same bits on any number of threads.
#include <limits>

#include "core/interrupt.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "simulate/forward/flux_rows.h"
#include "simulate/transport/estimate.h"
#include "simulate/transport/schedule.h"

namespace bpms {
namespace {

using FluxClock = std::chrono::steady_clock;

constexpr std::uint32_t flux_stream = 0xf1f10000u;  // keeps the numbers apart from those of sensors
constexpr std::uint64_t largest_flux_wave = 1 << 16;

class FluxRun {
 public:
  FluxRun(const Simulation& simulation, const Intersector& intersector, std::uint64_t seed,
          const FluxOptions& options)
      : stage_(simulation, intersector), rows_(stage_, options), seed_(seed) {
    for (const PhotonSource& source : stage_.sources) {
      tallies_.emplace_back(batches, FluxTally(stage_, rows_));
      sun_rays_.push_back(source.is_sun && !source.has_directions() && simulation.scene.domain.periodic
                              ? intersector.parallel_rays(simulation.scene, source.towards)
                              : nullptr);
    }
  }

  // The samples [first, last) of each batch of each source.
  void trace(std::uint64_t first, std::uint64_t last) {
    parallel_for(stage_.sources.size() * batches, [&](std::size_t i) {
      const std::size_t s = i / batches, batch = i % batches;
      FluxTally& tally = tallies_[s][batch];
      PhotonWave<FluxTally> wave(stage_, tally);
      const std::uint64_t step = std::max<std::uint64_t>(1, largest_flux_wave * 8 / stage_.optics.width);
      for (std::uint64_t from = first; from < last; from += step)
        wave.run(stage_.sources[s], sun_rays_[s].get(), {seed_, flux_stream, s},
                 static_cast<std::uint32_t>(batch), from, std::min(last, from + step));
      tally.photons += last - first;
      tally.rays += wave.rays();
    });
  }

  // Target over standard error, the smallest of the fluxes that target_se concerns.
  double reached() const {
    const Sampling& sampling = stage_.simulation->sampling;
    double worst = std::numeric_limits<double>::infinity();
    for (const Flux flux : {Flux::reflected, Flux::transmitted, Flux::absorbed_canopy}) {
      Estimates estimates;
      estimate(Origin::total, rows_.of(flux), rows_.of(flux) + 1, estimates);
      for (std::size_t band = 0; band < estimates.value.size(); ++band) {
        const double target =
            sampling.relative ? sampling.target_se * estimates.value[band] : sampling.target_se;
        if (estimates.standard_error[band] > 0)
          worst = std::min(worst, target / estimates.standard_error[band]);
      }
    }
    return worst;
  }

  FluxResult result() const {
    FluxResult out;
    out.rows = rows_.all();
    out.ground_area_m2 = (stage_.extent.high_m - stage_.extent.low_m).prod();
    out.origins = {Origin::total};
    bool direct = false, diffuse = false;
    for (const PhotonSource& source : stage_.sources)
      (source.origin == Origin::direct ? direct : diffuse) = true;
    if (direct && diffuse) out.origins = {Origin::total, Origin::direct, Origin::diffuse};
    for (const Origin origin : out.origins) {
      estimate(origin, 0, out.rows.size(), out.fraction.emplace_back());
      out.entering.push_back(stage_.simulation->bands.integrate(entering(origin)));
    }
    for (const auto& source : tallies_)
      for (const FluxTally& tally : source) out.samples += tally.photons, out.rays += tally.rays;
    return out;
  }

 private:
  static bool belongs(const PhotonSource& source, Origin origin) {
    return origin == Origin::total || source.origin == origin;
  }
  // Irradiance x m2 in the traced bands.
  std::vector<double> entering(Origin origin) const {
    std::vector<double> out(stage_.optics.bands, 0.0);
    for (const PhotonSource& source : stage_.sources)
      for (std::size_t band = 0; band < out.size() && belongs(source, origin); ++band)
        out[band] += source.irradiance[band] * source.entering_m2[band];
    return out;
  }
  // In the written bands.
  void estimate(Origin origin, std::size_t first, std::size_t last, Estimates& out) const {
    const Bands& bands = stage_.simulation->bands;
    const std::size_t traced = stage_.optics.bands, written = bands.written();
    const std::vector<double> all = bands.integrate(entering(origin));
    out.resize((last - first) * written);
    std::vector<double> power(traced);
    for (std::size_t row = first; row < last; ++row) {
      // A pixel's irradiance over that of the horizontal: the pixels' mean is what all of it would be.
      const double scale = rows_.all()[row].flux == Flux::ground_irradiance ? rows_.pixels() : 1.0;
      Moments moments(written);
      for (std::size_t batch = 0; batch < batches; ++batch) {
        std::fill(power.begin(), power.end(), 0.0);
        for (std::size_t s = 0; s < tallies_.size(); ++s) {
          const PhotonSource& source = stage_.sources[s];
          if (!belongs(source, origin)) continue;
          for (std::size_t band = 0; band < traced; ++band)
            power[band] +=
                source.irradiance[band] * source.entering_m2[band] * tallies_[s][batch].mean(row, band);
        }
        const std::vector<double> value = bands.integrate(power);
        for (std::size_t band = 0; band < written; ++band)
          moments.add(band, all[band] > 0 ? scale * value[band] / all[band] : 0.0, batch);
      }
      for (std::size_t band = 0; band < written; ++band) {
        out.value[(row - first) * written + band] = moments.mean(band);
        out.standard_error[(row - first) * written + band] = moments.standard_error(band, batches);
      }
    }
  }

  PhotonStage stage_;
  FluxRows rows_;
  std::uint64_t seed_;
  std::vector<std::vector<FluxTally>> tallies_;  // by source and batch
  std::vector<std::unique_ptr<ParallelRays>> sun_rays_;
};

// What there is time for, by the pace so far; `done` where it is too little for another round.
std::uint64_t goal_in_time(std::uint64_t done, FluxClock::time_point start, FluxClock::time_point deadline) {
  if (deadline == FluxClock::time_point::max()) return std::numeric_limits<std::uint64_t>::max();
  const auto seconds = [](FluxClock::duration d) { return std::chrono::duration<double>(d).count(); };
  const FluxClock::time_point now = FluxClock::now();
  const double growth = 1 + std::max(0.0, seconds(deadline - now)) / std::max(1e-9, seconds(now - start));
  constexpr double worth_a_round = 1.125, most_growth = 1e6;
  if (growth < worth_a_round) return done;
  return static_cast<std::uint64_t>(static_cast<double>(done) * std::min(growth, most_growth));
}

}  // namespace

FluxResult trace_fluxes(const Simulation& simulation, const Intersector& intersector, std::uint64_t seed,
                        const FluxOptions& options, FluxClock::time_point deadline) {
  for (const Material& material : simulation.materials)
    if (material.bump)
      fail(ErrorKind::bad_input, {},
           "material {} has a bump: what a tilted normal sends out is not bounded by what the surface "
           "receives, "
           "so its energy does not close; expected fluxes of materials without bumps",
           in_quotes(material.name));
  FluxRun run(simulation, intersector, seed, options);
  const Sampling& sampling = simulation.sampling;
  Progress progress("photons", 0);
  const FluxClock::time_point start = FluxClock::now();
  std::uint64_t done = 0;
  double reached = 0;
  bool out_of_time = false;
  for (;;) {
    std::uint64_t goal = next_size(sampling, done, reached);
    if (goal == done || (interrupted() && done > 0)) break;
    if (done > 0) goal = std::min(goal, goal_in_time(done, start, deadline));
    if (goal == done) {
      out_of_time = true;
      break;
    }
    throw_if_interrupted();
    run.trace(done, goal);
    progress.add((goal - done) * batches);
    done = goal;
    if (sampling.target_se > 0) reached = run.reached();
  }
  FluxResult out = run.result();
  out.map_px = options.map_px;
  out.stopped_by = interrupted()                           ? "interrupt"
                   : out_of_time                           ? "max_seconds"
                   : sampling.samples > 0                  ? "samples"
                   : sampling.target_se > 0 && reached < 1 ? "max_samples"
                                                           : "target_se";
  return out;
}

std::uint64_t flux_bytes(const Simulation& simulation, const FluxOptions& options) {
  std::uint64_t rows =
      static_cast<std::uint64_t>(Flux::absorbed_material) + simulation.materials.size() +
      static_cast<std::uint64_t>(options.layers) + options.layers_m.size() +
      static_cast<std::uint64_t>(options.map_px[0]) * static_cast<std::uint64_t>(options.map_px[1]);
  if (options.plants) rows += simulation.scene.instances.size();
  if (options.organs)
    for (const Prototype& prototype : simulation.scene.prototypes)
      rows += prototype.mesh ? prototype.mesh->organs.size() : 0;
  const std::uint64_t sources = simulation.light.suns.size() + (simulation.light.sky ? 1 : 0),
                      width = (simulation.bands.count() + 7) / 8 * 8;
  constexpr std::uint64_t most_origins = 3;
  return rows * (sizeof(FluxRow) + sources * batches * width * sizeof(double) +
                 most_origins * simulation.bands.written() * 2 * sizeof(double));
}

std::size_t FluxResult::row(Flux flux, std::uint32_t index, std::uint32_t prototype) const {
  std::size_t at = 0;
  while (at < rows.size() && !(rows[at].flux == flux && rows[at].index == index &&
                               (flux != Flux::absorbed_organ || rows[at].prototype == prototype)))
    ++at;
  return at;
}

const char* name_of(Flux flux) {
  constexpr std::array names{"reflected",        "transmitted",    "transmitted_first", "transmitted_direct",
                             "lost_sides",       "lost_wraps",     "absorbed_canopy",   "absorbed_ground",
                             "absorbed",         "absorbed_organ", "absorbed_plant",    "absorbed_layer",
                             "ground_irradiance"};
  return names[static_cast<std::size_t>(flux)];
}

}  // namespace bpms
