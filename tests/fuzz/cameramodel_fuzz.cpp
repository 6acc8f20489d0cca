// mrcal's camera models: whatever the bytes, a sound camera or one located line.
#include <cstddef>
#include <cstdint>

#include "calibrate/exchange/rig_file.h"
#include "tests/fuzz/answer.h"
#include "tests/fuzz/camera_file_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  bpms::fuzz::answer("fuzz.cameramodel",
                     [&] { bpms::fuzz::require_sound(bpms::parse_cameramodel("fuzz.cameramodel", text)); });
  return 0;
}
