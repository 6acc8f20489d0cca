// Scenes for tests, written as scene.toml and read back by the reader that users meet.
#pragma once
#include <string>

#include "simulate/simulate.h"
#include "tests/data.h"

namespace bpms::test {

inline Simulation simulation_of(const TemporaryFolder& folder, const std::string& text) {
  return read_simulation(folder.write("scene.toml", text));
}

// The part of a sensor's results with this origin, component and order.
inline const Estimates& part_of(const SensorResult& result, Origin origin,
                                Component component = Component::all, int order = every_order) {
  for (std::size_t p = 0; p < result.parts.size(); ++p) {
    const Part& part = result.parts[p];
    if (part.origin == origin && part.component == component && part.order == order)
      return result.radiance[p];
  }
  throw Error(ErrorKind::internal, "no such part");
}

}  // namespace bpms::test
