// Where copies of a prototype stand, as [[instances]] and the parts of a prototype say it: positions as a
// file or in place, rows `x y z`, `x y z rz_deg` or `x y z rz_deg ry_deg rx_deg` (turned about x first, then
// y, then z; right-handed, fixed axes), with `rotation_deg` about z added to all, and `scale`.
#pragma once
#include <string>
#include <vector>

#include "core/toml.h"
#include "scene/scene.h"

namespace bpms {
// Instance::prototype is left to the caller. A file that is read is added to `inputs`.
std::vector<Instance> read_placements(const TomlValue& table, std::vector<std::string>& inputs);
}  // namespace bpms
