// Whole canopies: whatever the bytes of a canopy.toml, a canopy or one located line. The files that it may
// name lie in a temporary folder and are always the same: plants, a folder of them, terrain, lists.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "plant/canopy.h"

namespace {

class CanopyFuzzFolder {
 public:
  CanopyFuzzFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "bpms-fuzz-XXXXXX").string();
    path_ = mkdtemp(name.data());
    write("a.bpms", "units cm l l { material leaf a_length 10 a_width 1 }");
    write(
        "b.bpms",
        "units cm [s[+l]] s { material stem a_length 5 a_radius 0.2 } + { a_twist 40 a_inclination 60 } l { "
        "material leaf a_length 4 a_width 2 }");
    write("bad.bpms", "units cm [l");
    write("set/p1.bpms", "units cm l l { material leaf a_length 10 a_width 1 }");
    write("set/p2.bpms", "units cm l l { material leaf a_length 8 a_width 1 }");
    write("flat.asc", "ncols 3\nnrows 3\nxllcenter -1\nyllcenter -1\ncellsize 1\n0 0 0\n0 0.5 0\n0 0 0\n");
    write("slope.asc", "ncols 3\nnrows 3\nxllcenter 9\nyllcenter 7\ncellsize 2\n0 1 2\n0 1 2\n0 1 2\n");
    write("list.txt", "0 0\n0.5 0.25 0.1 90\n");
    write("stems.csv",
          "x_m,y_m,z_m,rotation_deg,scale,plant\n0,0,,,,a.bpms\n0.5,0.5,0.1,10,1.2,b.bpms\n0.2,0.1,,,,\n");
  }
  ~CanopyFuzzFolder() {
    std::error_code code;
    std::filesystem::remove_all(path_, code);
  }
  CanopyFuzzFolder(const CanopyFuzzFolder&) = delete;
  CanopyFuzzFolder& operator=(const CanopyFuzzFolder&) = delete;
  std::string operator/(const char* name) const { return (path_ / name).string(); }

 private:
  void write(const char* name, const char* text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  std::filesystem::path path_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const CanopyFuzzFolder folder;
  constexpr std::size_t most_plants = 300;  // on average: numbers in rows and hills scatter
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const bpms::Canopy canopy = bpms::parse_canopy(folder / "canopy.toml", text, {{}, most_plants});
    if (canopy.placements.size() > 100 * most_plants || !(canopy.size_m.minCoeff() > 0)) std::abort();
    for (const bpms::Placement& p : canopy.placements) {
      if (p.plant >= canopy.plants.size() || !p.position_m.allFinite() || !std::isfinite(p.rotation) ||
          !(p.scale > 0))
        std::abort();
      if (std::abs(p.up.norm() - 1) > 1e-5f) std::abort();
    }
  } catch (const bpms::Error& error) {
    const bool absent = error.kind() == bpms::ErrorKind::missing_resource;
    if (error.kind() != bpms::ErrorKind::bad_input && !absent) std::abort();
    if (!absent && error.where().file.empty()) std::abort();
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
