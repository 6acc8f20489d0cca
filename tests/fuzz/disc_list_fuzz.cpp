// Disc lists: whatever the bytes, discs that can be traced or one located line.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "scene/importers/disc_list.h"
#include "tests/fuzz/answer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  bpms::fuzz::answer("fuzz.def", [&] {
    for (const bpms::Disc& disc : bpms::parse_disc_list("fuzz.def", text)) {
      if (!disc.centre_m.allFinite() || !(disc.radius_m > 0)) std::abort();
      constexpr float rounding = 1e-5f;
      if (!(std::abs(disc.normal.norm() - 1) < rounding)) std::abort();
    }
  });
  return 0;
}
