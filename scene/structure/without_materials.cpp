#include "scene/structure/without_materials.h"

#include <algorithm>

#include "core/error.h"
#include "core/nearest.h"
#include "plant/mesh_part.h"

namespace bpms {
namespace {

// Removes the elements of `list` that are of these materials.
template <class Element, class MaterialOf>
void remove_elements(std::vector<Element>& list, const std::vector<bool>& dropped,
                     const MaterialOf& material) {
  std::vector<Element> kept;
  for (std::size_t k = 0; k < list.size(); ++k)
    if (!dropped[material(k)]) kept.push_back(list[k]);
  list = std::move(kept);
}

void remove_organs(Prototype& prototype, const std::vector<bool>& dropped) {
  const auto gone = [&](std::uint32_t organ) { return dropped[prototype.material_of_organ[organ]]; };
  Mesh mesh = mesh_part(*prototype.mesh, [&](std::uint32_t organ) { return !gone(organ); });
  std::vector<std::uint32_t> number(mesh.organs.size(), no_organ), materials;
  std::vector<Mesh::Organ> rows;
  for (std::uint32_t k = 0; k < number.size(); ++k) {
    if (gone(k)) continue;
    number[k] = static_cast<std::uint32_t>(rows.size());
    rows.push_back(std::move(mesh.organs[k]));
    materials.push_back(prototype.material_of_organ[k]);
  }
  mesh.organs = std::move(rows);
  for (std::uint32_t& organ : mesh.organ_of_triangle) organ = number[organ];
  for (std::uint32_t& organ : prototype.organ_of_shape)
    if (organ != no_organ) organ = number[organ];
  prototype.material_of_organ = std::move(materials);
  prototype.mesh = std::make_shared<const Mesh>(std::move(mesh));
}

void remove_from(Prototype& prototype, const std::vector<bool>& dropped) {
  const std::vector<Shape> shapes = prototype.shapes;
  const auto of_shape = [&](std::size_t k) { return shapes[k].material; };
  if (!prototype.organ_of_shape.empty()) remove_elements(prototype.organ_of_shape, dropped, of_shape);
  remove_elements(prototype.shapes, dropped, of_shape);
  const std::vector<std::uint32_t> materials = prototype.material_of_disc;
  const auto of_disc = [&](std::size_t k) {
    return materials.empty() ? prototype.disc_material : materials[k];
  };
  remove_elements(prototype.discs, dropped, of_disc);
  if (!materials.empty()) remove_elements(prototype.material_of_disc, dropped, of_disc);
  if (prototype.mesh) remove_organs(prototype, dropped);
}

}  // namespace

Scene without_materials(Scene scene, const std::vector<std::string>& names) {
  std::vector<bool> dropped(scene.materials.size(), false);
  for (const std::string& name : names) {
    const auto found = std::find(scene.materials.begin(), scene.materials.end(), name);
    if (found == scene.materials.end())
      bad_input({}, "no surface is of material {} (--without){}", in_quotes(name),
                did_you_mean(name, scene.materials));
    dropped[static_cast<std::size_t>(found - scene.materials.begin())] = true;
  }
  for (Prototype& prototype : scene.prototypes) remove_from(prototype, dropped);
  return scene;
}

}  // namespace bpms
