// The table [ground] of a scene: a plane, or terrain that fits the domain.
#pragma once
#include "core/toml.h"
#include "scene/importers/materials.h"
#include "scene/scene.h"

namespace bpms {
Ground read_ground(const TomlValue& table, MaterialNames& names, Scene& scene);
}  // namespace bpms
