#include "scene/structure/split_scene.h"

#include <algorithm>

#include "plant/mesh_part.h"

namespace bpms {
namespace {

std::shared_ptr<const Mesh> part_of(const std::shared_ptr<const Mesh>& mesh, bool leaves) {
  if (!mesh) return nullptr;
  const auto wanted = [&](std::uint32_t organ) {
    return (organ < mesh->organs.size() && mesh->organs[organ].kind == "leaf") == leaves;
  };
  if (mesh->organ_of_triangle.empty()) return wanted(0) ? mesh : nullptr;
  const auto count = std::count_if(mesh->organ_of_triangle.begin(), mesh->organ_of_triangle.end(), wanted);
  if (count == 0) return nullptr;
  if (static_cast<std::size_t>(count) == mesh->triangles.size()) return mesh;
  Mesh out = mesh_part(*mesh, wanted);
  out.normals = {};
  out.uv = {};
  out.organs = {};
  out.organ_of_triangle = {};
  return std::make_shared<const Mesh>(std::move(out));
}

bool is_bare(const Prototype& prototype) {
  return prototype.discs.empty() && prototype.shapes.empty() && !prototype.mesh;
}

}  // namespace

Scene split_scene(const Scene& scene, SceneSurface keep) {
  const bool leaves = keep == SceneSurface::leaves;
  Scene out;
  out.domain = scene.domain;
  out.materials = scene.materials;
  if (scene.ground && scene.ground->terrain) {
    out.ground = scene.ground;
    out.ground->plane_outside = false;
  }
  for (const Prototype& from : scene.prototypes) {
    Prototype& to = out.prototypes.emplace_back();
    to.name = from.name;
    if (leaves)
      to.discs = from.discs;
    else
      to.shapes = from.shapes;
    to.mesh = part_of(from.mesh, leaves);
  }
  for (const Instance& instance : scene.instances)
    if (!is_bare(out.prototypes[instance.prototype])) out.instances.push_back(instance);
  return out;
}

}  // namespace bpms
