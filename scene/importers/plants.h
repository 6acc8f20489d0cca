// Plants and canopies of the plant floor as scenes: one prototype a plant, one instance a clone.
#pragma once
#include <string>

#include "core/toml.h"
#include "plant/canopy.h"
#include "plant/plant_mesh.h"
#include "scene/importers/materials.h"
#include "scene/scene.h"

namespace bpms {

// The prototype of a plant; its materials by their own names unless `all` or `renamed` say otherwise.
Prototype plant_prototype(const Plant& plant, const std::string& name, const std::string& all,
                          const TomlValue* renamed, const SourceLocation& where, MaterialNames& names,
                          const MeshOptions& meshes = {});
// Adds a canopy's plants and clones, and its ground if it has one, to the scene; the domain is left as it is.
void add_canopy(const Canopy& canopy, const SourceLocation& where, MaterialNames& names, Scene& scene,
                const MeshOptions& meshes = {});

// Scenes for a look at a structure alone: no ground, materials by the names in the plants.
// One plant at the origin, open domain.
Scene plant_scene(const std::string& path, const MeshOptions& meshes = {});
// A canopy in its own domain.
Scene canopy_scene(const std::string& path, const MeshOptions& meshes = {});

}  // namespace bpms
