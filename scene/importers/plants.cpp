#include "scene/importers/plants.h"

#include <filesystem>
#include <map>

#include "core/parallel.h"
#include "plant/mesh_part.h"
#include "plant/plant_file.h"
#include "plant/plant_mesh.h"
#include "plant/plant_solids.h"
#include "plant/stand_file.h"

namespace bpms {

namespace {

// What of a plant is traced: leaves as triangles, the other organs as solids (none: as triangles, too).
struct PlantParts {
  std::shared_ptr<const Mesh> mesh;
  std::vector<PlantSolid> solids;
};

PlantParts plant_parts(const Plant& plant, const MeshOptions& how) {
  PlantParts out{std::make_shared<const Mesh>(plant_mesh(plant, how)), {}};
  if (!how.bodies) out.solids = plant_solids(plant, how.tolerance_m);
  return out;
}

// The same from a mesh of the usual options that planting has made.
PlantParts plant_parts(const CanopyPlant& plant, const MeshOptions& how) {
  const MeshOptions usual;
  if (!plant.mesh || how.tolerance_m != usual.tolerance_m || how.parameters)
    return plant_parts(*plant.plant, how);
  if (how.bodies) return {plant.mesh, {}};
  const auto is_leaf = [&](std::uint32_t organ) {
    return plant.mesh->organs[organ].kind == organ_name(OrganKind::leaf);
  };
  return {std::make_shared<const Mesh>(mesh_part(*plant.mesh, is_leaf)),
          plant_solids(*plant.plant, how.tolerance_m)};
}

Shape shape_of_solid(const PlantSolid& solid, std::uint32_t material) {
  if (solid.kind == PlantSolid::Kind::frustum)
    return cylinder(solid.from_m, solid.to_m, solid.first_radius_m, solid.second_radius_m, true, material);
  const Eigen::Vector3d axis = solid.to_m - solid.from_m;
  const double half = axis.norm() / 2;
  return ellipsoid((solid.from_m + solid.to_m) / 2, {solid.first_radius_m, solid.first_radius_m, half},
                   Rotation(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis)), material);
}

Prototype prototype_of(PlantParts parts, const std::string& name, const std::string& all,
                       const TomlValue* renamed, const SourceLocation& where, MaterialNames& names) {
  Prototype out;
  out.name = name;
  out.mesh = std::move(parts.mesh);
  out.material_of_organ = organ_materials(*out.mesh, all, renamed, where, names);
  std::map<int, std::uint32_t> organ_of_id;
  for (std::size_t k = 0; k < out.mesh->organs.size(); ++k)
    organ_of_id.emplace(out.mesh->organs[k].id, static_cast<std::uint32_t>(k));
  for (const PlantSolid& solid : parts.solids) {
    const std::uint32_t organ = organ_of_id.at(solid.organ_id);
    out.shapes.push_back(shape_of_solid(solid, out.material_of_organ[organ]));
    out.organ_of_shape.push_back(organ);
  }
  return out;
}

// A canopy's plants, made on all threads where planting has not made them.
std::vector<PlantParts> canopy_parts(const Canopy& canopy, const MeshOptions& how) {
  std::vector<PlantParts> out(canopy.plants.size());
  parallel_for(out.size(), [&](std::size_t i) { out[i] = plant_parts(canopy.plants[i], how); });
  return out;
}

Rotation rotation_of(const Placement& p) {
  const Eigen::Vector3d up = p.up.cast<double>();
  if (up == Eigen::Vector3d::UnitZ()) return {p.rotation};
  return Rotation(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), up) *
                  Eigen::AngleAxisd(p.rotation, Eigen::Vector3d::UnitZ()));
}

}  // namespace

MeshOptions traced_plants() {
  MeshOptions out;
  out.bodies = false;
  return out;
}

Prototype mesh_prototype(std::shared_ptr<const Mesh> mesh, const std::string& name, const std::string& all,
                         const TomlValue* renamed, const SourceLocation& where, MaterialNames& names) {
  Prototype out;
  out.name = name;
  out.mesh = std::move(mesh);
  out.material_of_organ = organ_materials(*out.mesh, all, renamed, where, names);
  return out;
}

Prototype plant_prototype(const Plant& plant, const std::string& name, const std::string& all,
                          const TomlValue* renamed, const SourceLocation& where, MaterialNames& names,
                          const MeshOptions& how) {
  return prototype_of(plant_parts(plant, how), name, all, renamed, where, names);
}

void add_canopy(const Canopy& canopy, const SourceLocation& where, MaterialNames& names, Scene& scene,
                const MeshOptions& how) {
  const auto first = static_cast<std::uint32_t>(scene.prototypes.size());
  std::vector<PlantParts> parts = canopy_parts(canopy, how);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string name = std::filesystem::path(canopy.plants[i].file).stem().string();
    scene.prototypes.push_back(prototype_of(std::move(parts[i]), name, "", nullptr, where, names));
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

Scene plant_scene(const std::string& path, const MeshOptions& how) {
  Scene scene;
  scene.domain.periodic = false;
  MaterialNames names(scene);
  if (path.ends_with(".bpms")) {
    const Plant plant = read_plant(path);
    scene.prototypes.push_back(plant_prototype(plant, plant.name, "", nullptr, {path}, names, how));
    scene.inputs = plant.inputs;
    scene.notes = plant.warnings;
  } else {
    PlantFileOptions options;
    options.tolerance_m = how.tolerance_m;
    PlantFile plant = read_plant_file(path, options);
    scene.prototypes.push_back(mesh_prototype(std::make_shared<const Mesh>(std::move(plant.mesh)), plant.name,
                                              "", nullptr, {path}, names));
    scene.inputs = plant.inputs;
    scene.notes = plant.notes;
  }
  scene.instances.emplace_back();
  return scene;
}

Scene ops_scene(const std::string& path) {
  Scene scene;
  scene.domain.periodic = false;
  scene.inputs.push_back(path);
  MaterialNames names(scene);
  const Stand stand = ops_stand(path, [&](const std::string& file) {
    PlantFile plant = read_plant_file(file);
    scene.inputs.insert(scene.inputs.end(), plant.inputs.begin(), plant.inputs.end());
    scene.notes.insert(scene.notes.end(), plant.notes.begin(), plant.notes.end());
    return std::make_shared<const Mesh>(std::move(plant.mesh));
  });
  // The plot's corner is its origin; ours is the middle of the domain.
  scene.domain.size_m = stand.places.size_m;
  const Eigen::Vector3d middle(stand.places.origin_m.x() + stand.places.size_m.x() / 2,
                               stand.places.origin_m.y() + stand.places.size_m.y() / 2, 0);
  for (std::size_t i = 0; i < stand.meshes.size(); ++i)
    scene.prototypes.push_back(mesh_prototype(stand.meshes[i], stand.names[i], "", nullptr, {path}, names));
  for (std::size_t i = 0; i < stand.items.size(); ++i) {
    const OpsRow& row = stand.places.rows[i];
    const Eigen::Quaterniond turn(Eigen::Matrix3d(row.world_from_plant().linear() / row.scale));
    scene.instances.push_back({stand.items[i].mesh, row.position_m - middle, Rotation(turn), row.scale});
  }
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
