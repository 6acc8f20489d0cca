#include "scene/importers/plants.h"

#include <filesystem>

namespace bpms {

Prototype plant_prototype(const Plant& plant, const std::string& name, const std::string& all,
                          const TomlValue* renamed, const SourceLocation& where, MaterialNames& names,
                          const MeshOptions& meshes) {
  Prototype out;
  out.name = name;
  out.mesh = std::make_shared<const Mesh>(plant_mesh(plant, meshes));
  out.material_of_organ = organ_materials(*out.mesh, all, renamed, where, names);
  return out;
}

void add_canopy(const Canopy& canopy, const SourceLocation& where, MaterialNames& names, Scene& scene,
                const MeshOptions& meshes) {
  const auto first = static_cast<std::uint32_t>(scene.prototypes.size());
  for (const CanopyPlant& plant : canopy.plants) {
    const std::string name = std::filesystem::path(plant.file).stem().string();
    scene.prototypes.push_back(plant_prototype(*plant.plant, name, "", nullptr, where, names, meshes));
  }
  for (const Placement& p : canopy.placements)
    scene.instances.push_back({first + p.plant, p.position_m, p.rotation, p.scale});
  scene.inputs.insert(scene.inputs.end(), canopy.inputs.begin(), canopy.inputs.end());
  scene.notes.insert(scene.notes.end(), canopy.notes.begin(), canopy.notes.end());
}

Scene plant_scene(const std::string& path, const MeshOptions& meshes) {
  Scene scene;
  scene.domain.periodic = false;
  MaterialNames names(scene);
  const Plant plant = read_plant(path);
  scene.prototypes.push_back(plant_prototype(plant, plant.name, "", nullptr, {path}, names, meshes));
  scene.instances.emplace_back();
  scene.inputs.push_back(path);
  scene.notes = plant.warnings;
  return scene;
}

Scene canopy_scene(const std::string& path, const MeshOptions& meshes) {
  Scene scene;
  MaterialNames names(scene);
  const Canopy canopy = read_canopy(path);
  scene.domain.size_m = canopy.size_m;
  scene.domain.periodic = canopy.periodic;
  add_canopy(canopy, {path}, names, scene, meshes);
  return scene;
}

}  // namespace bpms
