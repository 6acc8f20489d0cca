// Plant texts: whatever the bytes, the reader answers with a plant or with bad input; what it accepted can be
// written, read back and written again to the same bytes, and laid out anew without a change to the plant.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "plant/plant.h"
#include "plant/plant_format.h"
#include "plant/plant_library.h"

namespace {

// The files that a text may include: no others are looked for.
std::string included(const std::string& path) {
  if (path == "organs.bpms")
    return "units mm let w = 3 organ tip(size = 1) { [l]l l { a_length (size) a_width (w) } } l 2 { a_length "
           "1 }";
  if (path == "loop.bpms") return "include \"loop.bpms\"";
  if (path == "again.bpms") return "include \"organs.bpms\" let again = (w ^ 2)";
  bpms::fail(bpms::ErrorKind::missing_resource, {path}, "no such file");
}

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const bool lenient : {false, true}) {
    try {
      const bpms::PlantReadOptions options{lenient, included};
      const bpms::Plant plant = bpms::parse_plant("fuzz.bpms", text, options);
      const std::string written = bpms::plant_text(plant);
      require(bpms::plant_text(bpms::parse_plant("fuzz.bpms", written)) == written);
      const std::string laid_out = bpms::formatted_plant("fuzz.bpms", text);
      require(bpms::plant_text(bpms::parse_plant("fuzz.bpms", laid_out, options)) == written);
      require(bpms::formatted_plant("fuzz.bpms", laid_out) == laid_out);
      if (plant.word.size() > 100 || plant.compounds.size() > 10) continue;
      int id = 0;
      for (const bpms::PlacedOrgan& organ : bpms::place_organs(plant)) require(organ.id == id++);
    } catch (const bpms::Error& error) {
      require(error.kind() == bpms::ErrorKind::bad_input ||
              error.kind() == bpms::ErrorKind::missing_resource);
    }
  }
  return 0;
}
