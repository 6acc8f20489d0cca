// Plants and canopies of the plant floor as scenes: one prototype a plant, one instance a clone.
#pragma once
#include <string>

#include "core/toml.h"
#include "plant/canopy.h"
#include "plant/plant_mesh.h"
#include "scene/importers/materials.h"
#include "scene/scene.h"

namespace bpms {

// How plants are made for rays: leaves as triangles; stems, buds and heads, which then have none, as shapes
// (plant/plant_solids.h). With `bodies` they are triangles like the leaves.
MeshOptions traced_plants();

// The prototype of a plant; its materials by their own names unless `all` or `renamed` say otherwise.
Prototype plant_prototype(const Plant& plant, const std::string& name, const std::string& all,
                          const TomlValue* renamed, const SourceLocation& where, MaterialNames& names,
                          const MeshOptions& how = traced_plants());
// The same for a mesh that is there already.
Prototype mesh_prototype(std::shared_ptr<const Mesh> mesh, const std::string& name, const std::string& all,
                         const TomlValue* renamed, const SourceLocation& where, MaterialNames& names);
// Adds a canopy's plants and clones, and its ground if it has one, to the scene; the domain is left as it is.
void add_canopy(const Canopy& canopy, const SourceLocation& where, MaterialNames& names, Scene& scene,
                const MeshOptions& how = traced_plants());

// Scenes for a look at a structure alone: no ground, materials by the names in the plants.
// One plant of any kind at the origin, open domain.
Scene plant_scene(const std::string& path, const MeshOptions& how = traced_plants());
// Plants of an OPS file in its plot, open domain.
Scene ops_scene(const std::string& path);
// A canopy in its own domain.
Scene canopy_scene(const std::string& path, const MeshOptions& how = traced_plants());

}  // namespace bpms
