// OBJ meshes: whatever the bytes, a mesh whose indices and coordinates are sound, or one located line.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "scene/importers/mesh_file.h"
#include "tests/fuzz/answer.h"

// Assimp 5.2 does not free what it had read of an OBJ that it then refuses; that is not looked for here.
extern "C" const char* __asan_default_options() {
  return "detect_leaks=0";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  bpms::fuzz::answer("fuzz.obj", [&] {
    const auto mesh = bpms::parse_mesh("fuzz.obj", bytes);
    if (mesh->organ_of_triangle.size() != mesh->triangles.size()) std::abort();
    for (const auto& triangle : mesh->triangles)
      for (const std::uint32_t vertex : triangle)
        if (vertex >= mesh->positions_m.size()) std::abort();
    for (const std::uint32_t organ : mesh->organ_of_triangle)
      if (organ >= mesh->organs.size()) std::abort();
    if (!mesh->normals.empty() && mesh->normals.size() != mesh->positions_m.size()) std::abort();
    if (!mesh->uv.empty() && mesh->uv.size() != mesh->positions_m.size()) std::abort();
    for (const Eigen::Vector3f& p : mesh->positions_m)
      if (!p.allFinite()) std::abort();
  });
  return 0;
}
