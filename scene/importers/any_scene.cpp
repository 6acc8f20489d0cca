#include "scene/importers/any_scene.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "core/units.h"
#include "plant/plant_file.h"
#include "scene/importers/mesh_file.h"

namespace bpms {
namespace {

bool is_mesh_file(const std::string& path) {
  std::string type = std::filesystem::path(path).extension().string();
  std::transform(type.begin(), type.end(), type.begin(), [](unsigned char c) { return std::tolower(c); });
  return type == ".ply" || type == ".obj" || type == ".glb" || type == ".gltf";
}

// A mesh alone, in an open scene of its own.
Scene scene_of_mesh(const std::string& path, const MeshFileArguments& arguments) {
  Scene scene;
  scene.domain.periodic = false;
  const double unit = arguments.unit.empty() ? 1 : metres_per_unit(arguments.unit, {"--unit"});
  const bool y_up = arguments.up.empty() ? mesh_file_is_y_up(path) : arguments.up == "y";
  Mesh mesh = *read_mesh_file(path, unit, y_up);
  for (const std::string& name : arguments.leaves) {
    bool used = false;
    for (Mesh::Organ& organ : mesh.organs) {
      if (organ.material != name && organ.label != name) continue;
      organ.kind = "leaf";
      used = true;
    }
    if (!used) bad_input({path}, "no group and no material is called {} (--leaves)", in_quotes(name));
  }
  Prototype& prototype = scene.prototypes.emplace_back();
  prototype.name = std::filesystem::path(path).stem().string();
  MaterialNames names(scene);
  for (const Mesh::Organ& organ : mesh.organs)
    prototype.material_of_organ.push_back(
        names.number(organ.material.empty() ? "unnamed" : organ.material, {path}));
  prototype.mesh = std::make_shared<const Mesh>(std::move(mesh));
  scene.instances.emplace_back();
  scene.inputs.push_back(path);
  return scene;
}

}  // namespace

Scene read_any_scene(const std::string& path, const MeshOptions& how, const MeshFileArguments& mesh) {
  if (is_mesh_file(path)) return scene_of_mesh(path, mesh);
  if (mesh.given()) bad_input({}, "--leaves, --unit and --up are for mesh files (.ply, .obj, .glb, .gltf)");
  if (is_plant_file(path)) return plant_scene(path, how);
  if (path.ends_with(".ops")) return ops_scene(path);
  const TomlDocument document = TomlDocument::read(path);
  if (document.root().has("planting") || document.root().has("plants")) return canopy_scene(path, how);
  return read_scene_geometry(document, how);
}

}  // namespace bpms
