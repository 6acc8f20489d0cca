#include "simulate/simulate.h"

#include <algorithm>
#include <numeric>

#include "core/interrupt.h"
#include "core/parallel.h"
#include "simulate/forward/choose_mode.h"
#include "simulate/forward/forward.h"
#include "simulate/forward/shared_views.h"
#include "simulate/memory_limit.h"
#include "simulate/output/sun_gap.h"
#include "simulate/transport/schedule.h"

namespace bpms {
namespace {

// Refuses a sensor that stands where no light comes. The views of most kinds start at one place; of a list of
// rays, so many are looked at.
void require_free(const Sensor& sensor, const Intersector& intersector, const Extent& extent) {
  if (sensor.parallel(0)) return;
  constexpr std::size_t most_places = 64;
  const std::size_t step =
      sensor.type == "rays" ? (sensor.views() + most_places - 1) / most_places : sensor.views();
  for (std::size_t view = step / 2; view < sensor.views(); view += step) {
    const Eigen::Vector3f place = sensor.start(view, {0.5, 0.5}, extent).origin;
    if (intersector.inside_solid(place.cast<double>()))
      fail(ErrorKind::bad_input, sensor.where,
           "sensor \"{}\" stands at ({:.4g}, {:.4g}, {:.4g}) m, inside a solid or below the ground",
           sensor.name, place.x(), place.y(), place.z());
  }
}

}  // namespace

Result simulate(const Simulation& simulation, std::uint64_t seed) {
  const auto start = std::chrono::steady_clock::now();
  IntersectorOptions options;
  options.most_bytes = simulation.most_bytes;
  const Intersector intersector(simulation.scene, options);
  Result out = simulate(simulation, intersector, seed);
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

Result simulate(const Simulation& simulation, const Intersector& intersector, std::uint64_t seed) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const Stage stage = make_stage(simulation, intersector);
  if (simulation.sampling.keep_interactions && stage.optics.carriage != Carriage::counted)
    fail(
        ErrorKind::bad_input, {},
        "interactions cannot be counted here: a surface or the sky has another shape in each band, bands are "
        "sampled, or shadows are attenuated");
  require_memory(simulation, stage);
  for (const auto& sensor : simulation.sensors) require_free(*sensor, intersector, stage.extent);
  Result out;
  out.seed = seed;
  out.threads = threads();
  if (std::any_of(simulation.sensors.begin(), simulation.sensors.end(),
                  [](const auto& sensor) { return sensor->type == "brf"; }))
    out.sun_gap = sun_gap(simulation.light, intersector, seed);
  Progress progress("paths", 0);
  bool out_of_time = false, out_of_samples = false;
  const std::size_t sensors = simulation.sensors.size() + simulation.fluxes.size();
  // Each sensor gets an equal part of the time, and what those before it left.
  const auto deadline_of = [&](std::size_t sensor) {
    if (!(simulation.sampling.max_seconds > 0)) return Clock::time_point::max();
    const double share = static_cast<double>(sensor + 1) / static_cast<double>(sensors);
    return start + std::chrono::duration_cast<Clock::duration>(
                       std::chrono::duration<double>(simulation.sampling.max_seconds * share));
  };
  for (std::size_t s = 0; s < simulation.sensors.size() && !interrupted(); ++s) {
    const Sensor& sensor = *simulation.sensors[s];
    Run run{&stage, seed, static_cast<std::uint32_t>(s), deadline_of(s), false, false, &progress};
    const Mode mode =
        choose_mode(simulation.sampling.mode, simulation, sensor, simulation.sampling.mode_where);
    if (mode == Mode::forward) {
      SharedViews shared =
          trace_shared_views(simulation, intersector, sensor, seed, run.sensor_index, run.deadline);
      run.out_of_time = shared.stopped_by == "max_seconds";
      run.out_of_samples = shared.stopped_by == "max_samples";
      shared.result.covariance = std::move(shared.covariance);
      out.sensors.push_back(std::move(shared.result));
    } else {
      out.sensors.push_back(run_sensor(run, sensor));
    }
    const SensorResult& last = out.sensors.back();
    out.samples += std::accumulate(last.samples.begin(), last.samples.end(), std::uint64_t{0});
    out.rays += last.rays;
    out_of_time = out_of_time || run.out_of_time;
    out_of_samples = out_of_samples || run.out_of_samples;
  }
  for (std::size_t f = 0; f < simulation.fluxes.size() && !interrupted(); ++f) {
    const FluxResult result = trace_fluxes(simulation, intersector, seed, simulation.fluxes[f].options,
                                           deadline_of(simulation.sensors.size() + f));
    out.samples += result.samples;
    out.rays += result.rays;
    out_of_samples = out_of_samples || result.stopped_by == "max_samples";
    out_of_time = out_of_time || result.stopped_by == "max_seconds";
    out.fluxes.push_back(std::make_shared<const FluxResult>(result));
  }
  out.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  out.stopped_by = simulation.sampling.samples > 0 ? "samples" : "target_se";
  if (out_of_samples) out.stopped_by = "max_samples";
  if (out_of_time) out.stopped_by = "max_seconds";
  if (interrupted()) {
    if (out.samples == 0) throw_if_interrupted();
    out.stopped_by = "interrupt";
  }
  return out;
}

const char* name_of(Origin origin) {
  return origin == Origin::total ? "total" : origin == Origin::direct ? "direct" : "diffuse";
}

const char* name_of(Component component) {
  switch (component) {
    case Component::all:
      return "all";
    case Component::uc_sgl:
      return "uc_sgl";
    case Component::co_sgl:
      return "co_sgl";
    case Component::mlt:
      return "mlt";
  }
  return "";
}

void Estimates::resize(std::size_t size) {
  value.assign(size, 0.0);
  standard_error.assign(size, 0.0);
}

}  // namespace bpms
