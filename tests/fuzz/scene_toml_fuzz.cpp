// Whole scenes: whatever the bytes of a scene.toml, the reader that `simulate` uses answers with a simulation
// or with one located line. The folder it would look for other files in does not exist, so that nothing but
// the text is read; reading writes nothing.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "simulate/simulate.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = "/nonexistent/fuzz/scene.toml";
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const bpms::Simulation simulation = bpms::parse_simulation(path, text);
    if (simulation.materials.size() != simulation.scene.materials.size()) std::abort();
    if ((simulation.sensors.empty() && simulation.fluxes.empty()) ||
        (simulation.light.suns.empty() && !simulation.light.sky))
      std::abort();
  } catch (const bpms::Error& error) {
    const bool absent = error.kind() == bpms::ErrorKind::missing_resource;
    if (error.kind() != bpms::ErrorKind::bad_input && !absent) std::abort();
    if (!absent && error.where().file != path) std::abort();
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
