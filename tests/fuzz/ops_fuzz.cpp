// OPS files: what is accepted reads back from what is written of it.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "plant/opf.h"
#include "tests/fuzz/answer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bpms;
  fuzz::answer("fuzz.ops", [&] {
    const OpsScene scene = parse_ops("fuzz.ops", {reinterpret_cast<const char*>(data), size});
    for (const OpsRow& row : scene.rows)
      if (!row.world_from_plant().matrix().allFinite()) std::abort();
    const std::string written = ops_text(scene);
    if (ops_text(parse_ops("fuzz.ops", written)) != written) std::abort();
  });
  return 0;
}
