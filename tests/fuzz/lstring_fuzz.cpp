// Derived strings: what is accepted is drawn with finite coordinates, or refused.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "plant/lsystem.h"
#include "tests/fuzz/answer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bpms;
  fuzz::answer("fuzz.lstr", [&] {
    const LString string = parse_lstring("fuzz.lstr", {reinterpret_cast<const char*>(data), size});
    const std::string written = lstring_text(string);
    if (lstring_text(parse_lstring("fuzz.lstr", written)) != written) std::abort();
    const TurtlePlant plant = turtle(string);
    for (const Eigen::Vector3f& p : plant.mesh.positions_m)
      if (!p.allFinite()) std::abort();
    if (!parse_mtg("fuzz.lstr", mtg_text(plant.mtg)).same_as(plant.mtg)) std::abort();
  });
  return 0;
}
