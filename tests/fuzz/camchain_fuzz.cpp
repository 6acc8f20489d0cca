// Kalibr's chains of cameras: whatever the bytes, a sound rig or one located line.
#include <cstddef>
#include <cstdint>

#include "calibrate/exchange/rig_file.h"
#include "tests/fuzz/answer.h"
#include "tests/fuzz/camera_file_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  bpms::fuzz::answer("fuzz.yaml", [&] {
    const bpms::Rig rig = bpms::parse_camchain("fuzz.yaml", text);
    if (rig.cameras.empty()) std::abort();
    for (const bpms::Camera& camera : rig.cameras) bpms::fuzz::require_sound(camera);
  });
  return 0;
}
