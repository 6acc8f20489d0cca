#include "simulate/transport/schedule.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "simulate/transport/rounds.h"

namespace bpms {
namespace {

// Rounded up to four steps an octave, which keeps Sobol points balanced.
std::uint64_t round_up(double paths) {
  auto n = static_cast<std::uint64_t>(std::ceil(paths));
  const std::uint64_t step = std::max<std::uint64_t>(1, std::bit_floor(n) / 4);
  return (n + step - 1) / step * step;
}

// The orders that are kept apart.
Rows kept_rows(const Stage& stage) {
  const Sampling& sampling = stage.simulation->sampling;
  constexpr int many_orders = 64, few_orders = 10;
  const Carriage carriage = stage.optics.carriage;
  const bool lean = carriage == Carriage::carried || carriage == Carriage::sampled;
  const int wanted = sampling.orders > 0 ? sampling.orders : lean ? many_orders : few_orders;
  return {stage.simulation->light.suns.size(),
          sampling.max_order > 0 ? std::min(wanted, sampling.max_order) : wanted};
}

template <class Tally>
void run_views(Run& run, const Sensor& sensor, const ViewStart<Tally>& start, SensorResult& result) {
  sensor.is_image() ? run_pixels(run, sensor, start, result) : run_directions(run, sensor, start, result);
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

std::uint64_t result_bytes(const Stage& stage, const Sensor& sensor) {
  const Simulation& simulation = *stage.simulation;
  const std::size_t suns = simulation.light.suns.size(), bands = simulation.bands.written();
  const std::size_t parts =
      parts_of(simulation.light, sensor.is_image() ? 0 : kept_rows(stage).orders).size();
  const std::size_t estimates = parts * bands + 1 + 3 * suns * simulation.materials.size() + suns;
  return sensor.views() * (estimates * 2 * sizeof(double) + bands * sizeof(double) + sizeof(std::uint64_t));
}

SensorResult run_sensor(Run& run, const Sensor& sensor) {
  const Simulation& simulation = *run.stage->simulation;
  const Optics& optics = run.stage->optics;
  const std::size_t bands = simulation.bands.written(), views = sensor.views(),
                    suns = simulation.light.suns.size(), by_material = suns * simulation.materials.size();
  Rows rows = kept_rows(*run.stage);
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
