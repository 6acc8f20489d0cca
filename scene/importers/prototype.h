// The tables [prototypes.X] of a scene: geometry of each kind, from its file.
#pragma once
#include <string>

#include "core/toml.h"
#include "plant/plant_mesh.h"
#include "scene/importers/materials.h"
#include "scene/scene.h"

namespace bpms {
// Is it made of other prototypes (`parts`)? It then must not have geometry of its own.
bool has_parts(const TomlValue& table);
// One with geometry. Files that are read are added to the scene's inputs, what is odd to its notes.
Prototype read_prototype(const std::string& name, const TomlValue& table, MaterialNames& names, Scene& scene,
                         const MeshOptions& how);
}  // namespace bpms
