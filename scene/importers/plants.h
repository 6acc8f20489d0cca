// Plants and canopies of the plant floor as scenes: one prototype a plant, one instance a clone.
#pragma once
#include <string>

#include "core/toml.h"
#include "plant/canopy.h"
#include "scene/importers/materials.h"
#include "scene/scene.h"

namespace bpms {

// Stems, buds and heads as shapes (plant/plant_solids.h), or as triangles like the leaves.
enum class PlantBodies { solids, triangles };

// The prototype of a plant; its materials by their own names unless `all` or `renamed` say otherwise.
Prototype plant_prototype(const Plant& plant, const std::string& name, const std::string& all,
                          const TomlValue* renamed, const SourceLocation& where, MaterialNames& names,
                          PlantBodies bodies = PlantBodies::solids);
// The same for a mesh that is there already.
Prototype mesh_prototype(std::shared_ptr<const Mesh> mesh, const std::string& name, const std::string& all,
                         const TomlValue* renamed, const SourceLocation& where, MaterialNames& names);
// Adds a canopy's plants and clones, and its ground if it has one, to the scene; the domain is left as it is.
void add_canopy(const Canopy& canopy, const SourceLocation& where, MaterialNames& names, Scene& scene);

// Scenes for a look at a structure alone: no ground, materials by the names in the plants.
Scene plant_scene(const std::string& path);   // one plant of any kind at the origin, open domain
Scene ops_scene(const std::string& path);     // plants of an OPS file in its plot, open domain
Scene canopy_scene(const std::string& path);  // a canopy in its own domain

}  // namespace bpms
