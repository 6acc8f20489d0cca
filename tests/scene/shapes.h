// Small scenes that the tests of the intersector share.
#pragma once
#include <memory>

#include "core/random.h"
#include "core/units.h"
#include "scene/scene.h"

namespace bpms::test {

inline Scene empty_scene(double size_m, bool periodic) {
  Scene scene;
  scene.domain.size_m = {size_m, size_m};
  scene.domain.periodic = periodic;
  scene.materials = {"leaf", "soil"};
  return scene;
}

inline Prototype disc_prototype(std::vector<Disc> discs) {
  Prototype out;
  out.name = "discs";
  out.discs = std::move(discs);
  return out;
}

// A bent strip of triangles along x, curved up at both ends: neighbours see each other on the upper side.
inline std::shared_ptr<const Mesh> bent_strip(int steps, float length_m, float width_m, float sag_m) {
  auto mesh = std::make_shared<Mesh>();
  for (int i = 0; i <= steps; ++i) {
    const float s = static_cast<float>(i) / static_cast<float>(steps) * 2 - 1;
    for (const float side : {-0.5f, 0.5f}) {
      mesh->positions_m.emplace_back(0.5f * length_m * s, side * width_m, sag_m * s * s);
      mesh->normals.push_back(Eigen::Vector3f(-4 * sag_m / length_m * s, 0, 1).normalized());
      mesh->uv.emplace_back(0.5f + 0.5f * s, side + 0.5f);
    }
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(steps); ++i) {
    mesh->triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    mesh->triangles.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
    mesh->organ_of_triangle.insert(mesh->organ_of_triangle.end(), {0, 0});
  }
  mesh->organs.push_back({0, "l1", "leaf", "leaf", length_m, static_cast<double>(length_m) * width_m});
  return mesh;
}

inline Prototype mesh_prototype(std::shared_ptr<const Mesh> mesh) {
  Prototype out;
  out.name = "mesh";
  out.material_of_organ.assign(mesh->organs.size(), 0);
  out.mesh = std::move(mesh);
  return out;
}

inline Eigen::Vector3f random_direction(Philox& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized().cast<float>();
}

// Discs with centres uniform in a box that stands on the origin.
inline std::vector<Disc> scattered_discs(Philox& random, int count, double half_width_m, double height_m,
                                         float radius_m) {
  std::vector<Disc> out;
  for (int k = 0; k < count; ++k) {
    const double x = random.uniform(-half_width_m, half_width_m);
    const double y = random.uniform(-half_width_m, half_width_m);
    const Eigen::Vector3d centre(x, y, random.uniform(0, height_m));
    out.push_back({centre.cast<float>(), radius_m, random_direction(random)});
  }
  return out;
}

}  // namespace bpms::test
