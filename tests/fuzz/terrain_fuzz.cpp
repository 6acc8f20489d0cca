// ESRI ASCII grids: whatever the bytes, heights or one located line.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "plant/terrain/terrain_file.h"
#include "tests/fuzz/answer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  bpms::fuzz::answer("fuzz.asc", [&] {
    bpms::Terrain terrain = bpms::parse_terrain("fuzz.asc", text);
    if (terrain.heights_m.size() != terrain.columns * terrain.rows) std::abort();
    if (!std::isfinite(terrain.height_m(terrain.low_m + 0.3 * terrain.size_m()))) std::abort();
    bpms::make_terrain_mesh(terrain, true);
    if (terrain.mesh->triangles.size() != 2 * (terrain.columns - 1) * (terrain.rows - 1)) std::abort();
  });
  return 0;
}
