// Patch files: whatever the bytes, patches or one located line; and what is not too fine is diced without
// anything that is not finite.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "scene/importers/patch_file.h"
#include "tests/fuzz/answer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  bpms::fuzz::answer("fuzz.bpt", [&] {
    const std::vector<bpms::BezierPatch> patches = bpms::parse_patches("fuzz.bpt", text);
    constexpr double coarse = 20;  // times the usual tolerance
    const bpms::Mesh mesh = bpms::dice_patches(patches, coarse * bpms::usual_patch_tolerance_m(patches));
    for (const Eigen::Vector3f& p : mesh.positions_m)
      if (!p.allFinite()) std::abort();
    for (const Eigen::Vector3f& n : mesh.normals)
      if (!n.allFinite()) std::abort();
  });
  return 0;
}
