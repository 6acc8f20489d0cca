#include "scene/importers/plants.h"

#include <filesystem>

#include "core/parallel.h"
#include "plant/plant_mesh.h"

namespace bpms {

namespace {

Prototype mesh_prototype(std::shared_ptr<const Mesh> mesh, const std::string& name, const std::string& all,
                         const TomlValue* renamed, const SourceLocation& where, MaterialNames& names) {
  Prototype out;
  out.name = name;
  out.mesh = std::move(mesh);
  out.material_of_organ = organ_materials(*out.mesh, all, renamed, where, names);
  return out;
}

// The meshes of a canopy's plants, made on all threads where planting has not made them.
std::vector<std::shared_ptr<const Mesh>> canopy_meshes(const Canopy& canopy, const MeshOptions& how) {
  const MeshOptions usual;
  const bool as_planted = how.tolerance_m == usual.tolerance_m && !how.parameters;
  std::vector<std::shared_ptr<const Mesh>> out(canopy.plants.size());
  parallel_for(out.size(), [&](std::size_t i) {
    const CanopyPlant& plant = canopy.plants[i];
    out[i] =
        plant.mesh && as_planted ? plant.mesh : std::make_shared<const Mesh>(plant_mesh(*plant.plant, how));
  });
  return out;
}

Rotation rotation_of(const Placement& p) {
  const Eigen::Vector3d up = p.up.cast<double>();
  if (up == Eigen::Vector3d::UnitZ()) return {p.rotation};
  return Rotation(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), up) *
                  Eigen::AngleAxisd(p.rotation, Eigen::Vector3d::UnitZ()));
}

}  // namespace

Prototype plant_prototype(const Plant& plant, const std::string& name, const std::string& all,
                          const TomlValue* renamed, const SourceLocation& where, MaterialNames& names,
                          const MeshOptions& meshes) {
  return mesh_prototype(std::make_shared<const Mesh>(plant_mesh(plant, meshes)), name, all, renamed, where,
                        names);
}

void add_canopy(const Canopy& canopy, const SourceLocation& where, MaterialNames& names, Scene& scene,
                const MeshOptions& how) {
  const auto first = static_cast<std::uint32_t>(scene.prototypes.size());
  const std::vector<std::shared_ptr<const Mesh>> meshes = canopy_meshes(canopy, how);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::string name = std::filesystem::path(canopy.plants[i].file).stem().string();
    scene.prototypes.push_back(mesh_prototype(meshes[i], name, "", nullptr, where, names));
  }
  scene.instances.reserve(scene.instances.size() + canopy.placements.size());
  for (const Placement& p : canopy.placements)
    scene.instances.push_back({first + p.plant, p.position_m, rotation_of(p), p.scale});
  if (canopy.ground) {
    Ground& ground = scene.ground.emplace();
    ground.terrain = canopy.ground->terrain;
    ground.material = names.number(canopy.ground->material, where);
    ground.plane_outside = canopy.ground->outside_height_m.has_value();
    ground.height_m = canopy.ground->outside_height_m.value_or(0);
  }
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
  scene.inputs = plant.inputs;
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
