#include "scene/importers/prototype.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "core/units.h"
#include "plant/plant_file.h"
#include "scene/importers/disc_list.h"
#include "scene/importers/mesh_file.h"
#include "scene/importers/patch_file.h"
#include "scene/importers/plants.h"
#include "scene/importers/shape_list.h"

namespace bpms {
namespace {

// What all kinds read of their table.
struct PrototypeTable {
  const TomlValue& table;
  std::string name;
  const MeshOptions& meshes;
  TomlValue material, materials;
  std::string all() const { return material ? material.string() : ""; }
  SourceLocation where() const { return material ? material.where() : table.where(); }
  const TomlValue* renamed() const { return materials ? &materials : nullptr; }
  // For what has no names of its own to be renamed.
  std::uint32_t one_material(const char* of, MaterialNames& names) const {
    if (materials) materials.reject(std::string(of) + " have one material: give `material`");
    if (!material) bad_input(table.where(), "[{}] needs material = \"...\"", table.name());
    return names.number(all(), where());
  }
};

std::string input(const TomlValue& path, Scene& scene) {
  scene.inputs.push_back(path.file_relative(path.string()));
  return scene.inputs.back();
}

double unit_of(const TomlValue& table) {
  const TomlValue unit = table.get("unit");
  return unit ? metres_per_unit(unit.string(), unit.where()) : 1;
}

Prototype from_discs(const PrototypeTable& of, const TomlValue& file, MaterialNames& names, Scene& scene) {
  Prototype out;
  const std::string path = input(file, scene);
  out.disc_material = of.one_material("discs", names);
  out.discs = read_disc_list(path);
  return out;
}

Prototype from_plant(const PrototypeTable& of, const TomlValue& file, MaterialNames& names, Scene& scene) {
  const std::string path = file.file_relative(file.string());
  PlantFileOptions options;
  if (const TomlValue unit = of.table.get("unit")) {
    if (path.ends_with(".bpms")) unit.reject("a plant text says its unit itself");
    options.opf.metres_per_unit = options.mtg.metres_per_unit = unit_of(of.table);
    options.mtg.metres_per_diameter_unit = options.mtg.metres_per_unit;
  }
  if (!is_plant_file(path))
    file.reject(fmt::format("expected a plant file ({})", fmt::join(plant_file_extensions(), " ")));
  MeshOptions how = of.meshes;
  if (const TomlValue solids = of.table.get("solids")) {
    if (!path.ends_with(".bpms")) solids.reject("for plants of the plant language alone (.bpms)");
    how.bodies = solids.one_of({"shapes", "triangles"}) == "triangles";
  }
  if (path.ends_with(".bpms")) {
    const Plant read = read_plant(path);
    scene.inputs.insert(scene.inputs.end(), read.inputs.begin(), read.inputs.end());
    scene.notes.insert(scene.notes.end(), read.warnings.begin(), read.warnings.end());
    return plant_prototype(read, of.name, of.all(), of.renamed(), of.where(), names, how);
  }
  PlantFile read = read_plant_file(path, options);
  scene.inputs.insert(scene.inputs.end(), read.inputs.begin(), read.inputs.end());
  scene.notes.insert(scene.notes.end(), read.notes.begin(), read.notes.end());
  return mesh_prototype(std::make_shared<const Mesh>(std::move(read.mesh)), of.name, of.all(), of.renamed(),
                        of.where(), names);
}

Prototype from_mesh(const PrototypeTable& of, const TomlValue& file, MaterialNames& names, Scene& scene) {
  Prototype out;
  const std::string path = input(file, scene);
  const TomlValue up = of.table.get("up");
  const bool y_up = up ? up.one_of({"z", "y"}) == "y" : mesh_file_is_y_up(path);
  out.mesh = read_mesh_file(path, unit_of(of.table), y_up);
  out.material_of_organ = organ_materials(*out.mesh, of.all(), of.renamed(), of.where(), names);
  return out;
}

Prototype from_shapes(const PrototypeTable& of, const TomlValue& file, MaterialNames& names, Scene& scene) {
  if (of.materials) of.materials.reject("shapes name their materials themselves, or have `material`");
  Prototype out;
  out.shapes = read_shape_list(input(file, scene), of.all(), of.where(), names);
  return out;
}

Prototype from_patches(const PrototypeTable& of, const TomlValue& file, MaterialNames& names, Scene& scene) {
  Prototype out;
  const std::string path = input(file, scene);
  const std::uint32_t material = of.one_material("patches", names);
  const std::vector<BezierPatch> patches = read_patch_file(path, unit_of(of.table));
  double tolerance = usual_patch_tolerance_m(patches);
  const TomlValue given = of.table.get("tolerance_m");
  if (given) tolerance = given.positive();
  Mesh mesh;
  try {
    mesh = dice_patches(patches, tolerance);
  } catch (const Error& error) {
    throw Error(error.kind(), (given ? given : file).where(), error.message());
  }
  for (Mesh::Organ& organ : mesh.organs) {
    organ.material = of.all();
    organ.kind = names_a_leaf(of.all()) || names_a_leaf(of.name) ? "leaf" : "mesh";
  }
  out.material_of_organ.assign(mesh.organs.size(), material);
  out.mesh = std::make_shared<const Mesh>(std::move(mesh));
  return out;
}

struct GeometryKind {
  const char* key;
  Prototype (*read)(const PrototypeTable&, const TomlValue&, MaterialNames&, Scene&);
};
constexpr GeometryKind geometry_kinds[] = {{"discs", &from_discs},
                                           {"plant", &from_plant},
                                           {"mesh", &from_mesh},
                                           {"shapes", &from_shapes},
                                           {"patches", &from_patches}};

}  // namespace

bool has_parts(const TomlValue& table) {
  if (!table.get("parts")) return false;
  for (const GeometryKind& kind : geometry_kinds)
    if (const TomlValue value = table.get(kind.key))
      value.reject("a prototype with `parts` has no geometry of its own: make that a part");
  return true;
}

Prototype read_prototype(const std::string& name, const TomlValue& table, MaterialNames& names, Scene& scene,
                         const MeshOptions& meshes) {
  for (const char* later : {"canopy", "librat", "volume"})
    if (const TomlValue value = table.get(later)) value.reject("prototypes of this kind are not built yet");
  const GeometryKind* chosen = nullptr;
  int given = 0;
  for (const GeometryKind& kind : geometry_kinds) {
    if (!table.get(kind.key)) continue;
    chosen = &kind;
    ++given;
  }
  if (given != 1)
    bad_input(table.where(), "[{}] needs one of discs, plant, mesh, shapes, patches, parts", table.name());
  const PrototypeTable of{table, name, meshes, table.get("material"), table.get("materials")};
  Prototype out = chosen->read(of, table.get(chosen->key), names, scene);
  out.name = name;
  return out;
}

}  // namespace bpms
