#include "simulate/memory_limit.h"

#include "core/error.h"
#include "simulate/forward/forward.h"
#include "simulate/transport/schedule.h"

namespace bpms {

void require_memory(const Simulation& simulation, const Stage& stage) {
  if (simulation.most_bytes == 0) return;
  std::uint64_t sum = stage.intersector->estimated_bytes(), most = sum;
  std::string which = "what is traced";
  const auto add = [&](std::uint64_t bytes, std::string what) {
    sum += bytes;
    if (bytes > most) most = bytes, which = std::move(what);
  };
  for (const auto& sensor : simulation.sensors)
    add(result_bytes(stage, *sensor),
        fmt::format("the results of sensor {} ({} views, {} bands)", in_quotes(sensor->name), sensor->views(),
                    simulation.bands.written()));
  for (const FluxSensor& flux : simulation.fluxes)
    add(flux_bytes(simulation, flux.options),
        fmt::format("the fluxes of sensor {} ({} x {} pixels, {} bands)", in_quotes(flux.name),
                    flux.options.map_px[0], flux.options.map_px[1], simulation.bands.count()));
  if (sum <= simulation.most_bytes) return;
  const auto gib = [](std::uint64_t bytes) { return static_cast<double>(bytes) / (1u << 30); };
  fail(ErrorKind::missing_resource, {},
       "the scene and the results need some {:.3g} GiB, the limit is {:.3g} GiB; most of it goes to {}: "
       "{:.3g} GiB",
       gib(sum), gib(simulation.most_bytes), which, gib(most));
}

}  // namespace bpms
