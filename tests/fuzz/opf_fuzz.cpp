// OPF files: what is accepted has finite coordinates and sound indices, and reads back from what is written
// of it.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "plant/opf.h"
#include "tests/fuzz/answer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bpms;
  fuzz::answer("fuzz.opf", [&] {
    const OpfPlant plant = parse_opf("fuzz.opf", {reinterpret_cast<const char*>(data), size});
    for (const Eigen::Vector3f& p : plant.mesh.positions_m)
      if (!p.allFinite()) std::abort();
    for (const auto& triangle : plant.mesh.triangles)
      for (const std::uint32_t vertex : triangle)
        if (vertex >= plant.mesh.positions_m.size()) std::abort();
    const std::string written = opf_text(plant.mesh, plant.mtg, plant.organ_of_vertex);
    if (parse_opf("fuzz.opf", written).mesh.triangles.size() > plant.mesh.triangles.size()) std::abort();
  });
  return 0;
}
