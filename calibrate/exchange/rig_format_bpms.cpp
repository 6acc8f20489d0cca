// bpms' own rig.toml as one of the formats.
#include "calibrate/exchange/rig_file.h"

namespace bpms {
namespace {

RigFromFile read_own_rig(const std::vector<std::string>& paths, const RigReading&) {
  if (paths.size() > 1) bad_input({paths[1]}, "one rig.toml holds the whole rig; a second one is given");
  return {read_rig(paths.front()), {}};
}

}  // namespace

const RigFormat& bpms_rig_format() {
  static const RigFormat format{"bpms", "rig.toml of bpms",
                                [](const std::string& path, std::string_view head) {
                                  return path.ends_with(".toml") ||
                                         head.find("[[cameras]]") != std::string_view::npos;
                                },
                                read_own_rig,
                                [](const Rig& rig, const std::string& path) {
                                  return FilesOfRig{{{path, rig_toml(rig)}}, {}};
                                }};
  return format;
}

}  // namespace bpms
