// MTG files: what is accepted can be written, read back and written again to the same bytes, and laid out or
// refused.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "plant/mtg.h"
#include "tests/fuzz/answer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bpms;
  fuzz::answer("fuzz.mtg", [&] {
    const Mtg mtg = parse_mtg("fuzz.mtg", {reinterpret_cast<const char*>(data), size});
    constexpr std::size_t small = 10'000;
    if (mtg.vertices.size() > small) return;
    const std::string written = mtg_text(mtg);
    const Mtg again = parse_mtg("fuzz.mtg", written);
    if (!again.same_as(mtg) || mtg_text(again) != written) std::abort();
    std::vector<std::string> notes;
    const Mesh mesh = mtg_mesh(mtg, {}, notes);
    for (const Eigen::Vector3f& p : mesh.positions_m)
      if (!p.allFinite()) std::abort();
  });
  return 0;
}
