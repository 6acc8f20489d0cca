#include "simulate/sensors/flux_sensor.h"

namespace bpms {

FluxOptions read_flux_options(const TomlValue& table) {
  constexpr int most_layers = 10000, most_pixels = 4096;
  FluxOptions out;
  const TomlValue edges = table.get("layers_m"), layers = table.get("layers"), map = table.get("map_px");
  out.organs = table.boolean_or("organs", true);
  out.plants = table.boolean_or("plants", false);
  if (edges && layers) layers.reject("expected one of layers and layers_m");
  if (layers) out.layers = static_cast<int>(layers.integer(1, most_layers));
  if (edges) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      out.layers_m.push_back(edges[i].number());
      if (i > 0 && !(out.layers_m[i] > out.layers_m[i - 1]))
        edges[i].reject(fmt::format("{} does not lie above {}: expected rising heights", out.layers_m[i],
                                    out.layers_m[i - 1]));
    }
    if (out.layers_m.size() < 2) edges.reject("expected at least two heights, the edges of the layers");
  }
  if (map) {
    if (!map.is_array() || map.size() != 2) map.reject("expected [columns, rows]");
    for (std::size_t i = 0; i < 2; ++i) out.map_px[i] = static_cast<int>(map[i].integer(1, most_pixels));
  }
  return out;
}

}  // namespace bpms
