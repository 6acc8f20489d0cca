// The noun of the scene floor: geometry, instances and material names, ready to be traced.
// What scene.toml says under domain, ground, prototypes and instances; metres, z up, x east, y north.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/toml.h"
#include "plant/mesh.h"
#include "plant/terrain.h"
#include "scene/geometry/shape.h"
#include "scene/rotation.h"

namespace bpms {

struct Domain {
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  // centred at the origin; zero: not given
  bool periodic = true;
  bool azimuth_north_clockwise = true;  // false: east_counterclockwise
};

struct Disc {
  Eigen::Vector3f centre_m;
  float radius_m;
  Eigen::Vector3f normal;  // unit; the upper (front) face looks this way
};

inline constexpr std::uint32_t no_organ = 0xffffffffu;

// A thing that is placed many times. Materials are indices into Scene::materials.
struct Prototype {
  std::string name;
  std::vector<Disc> discs;
  std::uint32_t disc_material = 0;
  std::vector<std::uint32_t> material_of_disc;   // empty: disc_material for all
  std::shared_ptr<const Mesh> mesh;              // or null
  std::vector<std::uint32_t> material_of_organ;  // of the mesh's organs
  std::vector<Shape> shapes;
  // Of the mesh's organs: which one each shape is a part of. The organ's area then counts, and not the
  // shape's, some of which lies inside of its neighbours. Empty: no shape is part of an organ.
  std::vector<std::uint32_t> organ_of_shape;
  std::uint32_t organ_of(std::size_t shape) const {
    return organ_of_shape.empty() ? no_organ : organ_of_shape[shape];
  }
};

inline constexpr std::uint32_t no_plant = 0xffffffffu;

// Scaled, turned, then moved.
struct Instance {
  std::uint32_t prototype = 0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Rotation rotation = {};
  double scale = 1;
  // The plant it is a part of: which of all the rows of all [[instances]] (and clones of the canopy) put it
  // there.
  std::uint32_t plant = no_plant;
};

// An infinite level plane, or terrain: then the plane (if any) is what lies outside of it.
struct Ground {
  double height_m = 0;  // of the plane
  std::uint32_t material = 0;
  std::shared_ptr<const Terrain> terrain = nullptr;
  bool plane_outside = false;  // of terrain
  bool has_plane() const { return !terrain || plane_outside; }
  double height_at(const Eigen::Vector2d& at) const {
    return terrain && (terrain->covers(at) || !plane_outside) ? terrain->height_m(at) : height_m;
  }
};

struct Scene {
  Domain domain;
  std::vector<std::string> materials;  // names that geometry uses, in order of first use
  std::vector<Prototype> prototypes;
  std::vector<Instance> instances;
  std::optional<Ground> ground;
  std::vector<std::string> inputs;  // files it was read from, for the provenance
  std::vector<std::string> notes;
};

// Reads the geometry part of a scene.toml; the caller reads the rest and then calls document.finish().
Scene read_scene_geometry(const TomlDocument& document);
struct MeshOptions;  // how plants become triangles (plant/plant_mesh.h)
Scene read_scene_geometry(const TomlDocument& document, const MeshOptions& meshes);

// The azimuth of a horizontal direction and back, in the scene's convention.
Eigen::Vector3d direction_from_angles(double zenith, double azimuth, const Domain& domain);

}  // namespace bpms
