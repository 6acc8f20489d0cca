// L-systems: what is accepted derives its first steps, or is refused; the string reads back as it was
// written.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "plant/lsystem.h"
#include "tests/fuzz/answer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bpms;
  fuzz::answer("fuzz.lsys", [&] {
    const LSystem system = parse_lsystem("fuzz.lsys", {reinterpret_cast<const char*>(data), size});
    const LString string = derive(system, std::min(system.steps, 2));
    constexpr std::size_t small = 10'000;
    if (string.modules.empty() || string.modules.size() > small) return;
    const std::string written = lstring_text(string);
    if (lstring_text(parse_lstring("fuzz.lsys", written)) != written) std::abort();
  });
  return 0;
}
