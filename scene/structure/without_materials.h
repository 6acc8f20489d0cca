// A scene without what is of some materials: a stand without its dead leaves, or its stems.
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace bpms {
// The ground stays. bad_input for a name that no surface has.
Scene without_materials(Scene scene, const std::vector<std::string>& names);
}  // namespace bpms
