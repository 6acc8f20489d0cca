// board.toml, control_frame.toml and boards in YAML: whatever the bytes, a target whose points are finite and
// which reads back, or one located line.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "calibrate/targets/target.h"
#include "tests/fuzz/answer.h"

namespace {

void read_one(const char* file, std::string_view text) {
  bpms::fuzz::answer(file, [&] {
    const bpms::Target target = bpms::parse_board(file, text);
    const auto points = target.points_m();
    if (points.empty() || static_cast<int>(points.size()) != target.size()) std::abort();
    for (const auto& x : points)
      if (!x.allFinite()) std::abort();
    for (const auto& w : target.bending())
      if (!w.allFinite()) std::abort();
    if (!target.covariance_m2.empty() && target.covariance_m2.size() != points.size()) std::abort();
    const bpms::Target back = bpms::parse_board("fuzz.toml", bpms::board_toml(target));
    if (back.size() != target.size()) std::abort();
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  read_one("fuzz.toml", text);
  read_one("fuzz.yaml", text);
  return 0;
}
