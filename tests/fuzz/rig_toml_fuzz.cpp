// rig.toml: whatever the bytes, a rig that reads back as it is, or one located line.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/camera_file_fuzz.h"
#include "tests/fuzz/file_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  bpms::fuzz::answer_of_file(reinterpret_cast<const char*>(data), size, ".toml", [](const std::string& path) {
    const bpms::Rig rig = bpms::read_rig(path);
    if (rig.cameras.empty()) std::abort();
    for (const bpms::Camera& camera : rig.cameras) bpms::fuzz::require_sound(camera);
    if (rig.covariance &&
        rig.covariance->matrix.rows() != static_cast<Eigen::Index>(rig.covariance->order.size()))
      std::abort();
    if (bpms::rig_toml(rig).empty()) std::abort();
  });
  return 0;
}
