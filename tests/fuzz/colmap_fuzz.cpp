// COLMAP's models: a first byte says text or binary, the three files follow, each up to a byte 0xff 0xfe
// pair. Whatever the bytes, a model whose indices are sound and that reads back from what is written of it,
// or one line.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "calibrate/exchange/colmap_model.h"
#include "tests/fuzz/answer.h"
#include "tests/fuzz/camera_file_fuzz.h"

namespace {

void require_sound_model(const bpms::ColmapModel& model) {
  for (const bpms::Camera& camera : model.cameras) bpms::fuzz::require_sound(camera);
  const auto within = [](int index, std::size_t size) {
    return index >= 0 && static_cast<std::size_t>(index) < size;
  };
  for (const bpms::ColmapImage& image : model.images) {
    if (!within(image.camera, model.cameras.size()) || image.points.size() != image.keypoints_px.size())
      std::abort();
    for (const int point : image.points)
      if (point != -1 && !within(point, model.points.size())) std::abort();
  }
  for (const bpms::ColmapPoint& point : model.points) {
    if (!point.x_world.allFinite() || !std::isfinite(point.error_px)) std::abort();
    for (const auto& sight : point.track)
      if (!within(sight.image, model.images.size()) ||
          !within(sight.keypoint, model.images[static_cast<std::size_t>(sight.image)].keypoints_px.size()))
        std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  std::string rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  bpms::ColmapFiles files{"fuzz", "", "fuzz", "", "fuzz", ""};
  for (std::string* part : {&files.cameras, &files.images, &files.points}) {
    const std::size_t end = rest.find("\xff\xfe");
    *part = rest.substr(0, end);
    rest = end == std::string::npos ? "" : rest.substr(end + 2);
  }
  bpms::fuzz::answer("fuzz", [&] {
    require_sound_model(data[0] == 'b' ? bpms::parse_colmap_binary(files) : bpms::parse_colmap_text(files));
  });
  return 0;
}
