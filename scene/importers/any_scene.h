// The scene in a file of any kind, told by name and content: a plant, a stand (canopy.toml, .ops), a scene
// (its geometry) or a mesh.
#pragma once
#include <string>
#include <vector>

#include "plant/plant_mesh.h"
#include "scene/importers/plants.h"
#include "scene/scene.h"

namespace bpms {

// What a mesh file does not say itself. All empty: metres, the usual way up, leaves by their names.
struct MeshFileArguments {
  std::string unit;                 // "cm"
  std::string up;                   // "y", "z"
  std::vector<std::string> leaves;  // groups or materials that are leaves, beside those whose names say so
  bool given() const { return !unit.empty() || !up.empty() || !leaves.empty(); }
};

Scene read_any_scene(const std::string& path, const MeshOptions& how = traced_plants(),
                     const MeshFileArguments& mesh = {});

}  // namespace bpms
