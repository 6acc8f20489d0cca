// Plant texts: whatever the bytes, the reader answers with a plant or with bad input, and what it accepted
// can be written, read back and written again to the same bytes.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "plant/plant.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const bool lenient : {false, true}) {
    try {
      const bpms::Plant plant = bpms::parse_plant("fuzz.bpms", text, {lenient});
      const std::string written = bpms::plant_text(plant);
      if (bpms::plant_text(bpms::parse_plant("fuzz.bpms", written)) != written) std::abort();
    } catch (const bpms::Error& error) {
      if (error.kind() != bpms::ErrorKind::bad_input) std::abort();
    }
  }
  return 0;
}
