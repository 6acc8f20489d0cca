#include "scene/pictures/subject.h"

#include <algorithm>
#include <cmath>

#include "scene/intersect/box.h"

namespace bpms {
namespace {

Box box_of_instances(const Scene& scene) {
  std::vector<Box> own;
  for (const Prototype& prototype : scene.prototypes) own.push_back(bounds(prototype));
  Box out;
  for (const Instance& instance : scene.instances)
    if (!own[instance.prototype].empty()) out.include(bounds(own[instance.prototype], instance));
  return out;
}

std::shared_ptr<const Mesh> sheet(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double height) {
  Mesh mesh;
  const Eigen::Vector2f a = low.cast<float>(), b = high.cast<float>();
  const auto z = static_cast<float>(height);
  mesh.positions_m = {{a.x(), a.y(), z}, {b.x(), a.y(), z}, {b.x(), b.y(), z}, {a.x(), b.y(), z}};
  mesh.normals.assign(4, Eigen::Vector3f::UnitZ());
  mesh.uv = {{0.f, 0.f}, {1.f, 0.f}, {1.f, 1.f}, {0.f, 1.f}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.organ_of_triangle = {0, 0};
  mesh.organs.emplace_back();
  mesh.organs.back().area_m2 = (high - low).prod();
  return std::make_shared<const Mesh>(std::move(mesh));
}

// One organ of kind "ground", whatever the terrain's mesh says of itself.
std::shared_ptr<const Mesh> named_ground(const Mesh& mesh, const std::string& material) {
  Mesh out = mesh;
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += triangle_area_m2(mesh, t);
  out.organs.assign(1, {});
  out.organs[0].label = out.organs[0].kind = ground_kind;
  out.organs[0].material = material;
  out.organs[0].length_m = std::nan("");
  out.organs[0].area_m2 = area;
  out.organ_of_triangle.assign(mesh.triangles.size(), 0);
  return std::make_shared<const Mesh>(std::move(out));
}

void add_ground(Scene& scene) {
  const Ground ground = *scene.ground;
  scene.ground.reset();
  std::shared_ptr<const Mesh> mesh = ground.terrain ? ground.terrain->mesh : nullptr;
  if (!mesh) {
    Eigen::Vector2d low = -0.5 * scene.domain.size_m, high = 0.5 * scene.domain.size_m;
    if (!(scene.domain.size_m.minCoeff() > 0)) {
      const Box box = box_of_instances(scene);
      if (box.empty()) return;
      const Eigen::Vector3d size = box.high - box.low;
      const Eigen::Vector2d margin =
          Eigen::Vector2d::Constant(0.1 * std::max(size.head<2>().maxCoeff(), 0.5 * size.z()));
      low = box.low.head<2>() - margin, high = box.high.head<2>() + margin;
    }
    mesh = sheet(low, high, ground.height_m);
  }
  Prototype prototype;
  prototype.name = ground_kind;
  prototype.mesh = named_ground(*mesh, scene.materials[ground.material]);
  prototype.material_of_organ = {ground.material};
  scene.instances.emplace_back();
  scene.instances.back().prototype = static_cast<std::uint32_t>(scene.prototypes.size());
  scene.prototypes.push_back(std::move(prototype));
}

}  // namespace

Scene picture_subject(Scene scene, const std::string& path) {
  scene.domain.periodic = false;
  if (scene.ground) add_ground(scene);
  const Box box = box_of_instances(scene);
  if (box.empty() || !((box.high - box.low).norm() > 0))
    bad_input({path}, "nothing to see: no organ has an extent");
  return scene;
}

}  // namespace bpms
