// The table [ground] of a scene: a plane, or terrain that fits the domain. A canopy that has terrain brings
// its own ground; then the scene has no other, and the canopy's domain.
#pragma once
#include "core/toml.h"
#include "scene/importers/materials.h"
#include "scene/scene.h"

namespace bpms {
Ground read_ground(const TomlValue& table, MaterialNames& names, Scene& scene);
// The domain in which the scene is traced must be the one that the terrain of its canopy was fitted to.
void check_canopy_ground(const Domain& canopy, const Domain& scene, const TomlValue& domain);
// The ground that a scene with such a canopy declares is the canopy's, or bad_input.
void check_same_ground(const Ground& canopys, const Ground& scenes, const TomlValue& table);
}  // namespace bpms
