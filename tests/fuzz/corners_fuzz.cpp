// Tables of corners (.vnl): whatever the bytes, views whose corners lie in the image, or one located line.
#include <cstddef>
#include <cstdint>

#include "calibrate/observations.h"
#include "tests/fuzz/file_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bpms::fuzz::answer_of_file(reinterpret_cast<const char*>(data), size, ".vnl", [](const std::string& path) {
    const bpms::Observations o = bpms::read_corners(path, 640, 480, 2);
    for (const bpms::BoardView& view : o.views) {
      if (view.camera < 0 || static_cast<std::size_t>(view.camera) >= o.cameras.size()) std::abort();
      for (const bpms::ImageCorner& corner : view.corners)
        if (corner.point < 0 || corner.point >= 2 || !corner.pixel.allFinite()) std::abort();
    }
  });
  return 0;
}
