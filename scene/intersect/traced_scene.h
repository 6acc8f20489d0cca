// The scene as the intersector traces it: prototypes with their normals, copies of instances over a periodic
// cell, and the hierarchy (BVH) over them.
//
// A periodic cell is completed with the copies, shifted by whole cells, of everything that crosses its
// border. (A wider margin of copies, which saves rays their change of sides, was tried: no faster on HET01
// and a thin layer.) Instances, triangles and shapes are numbered as in the Scene, discs by clusters. Terrain
// is one more instance after the scene's.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scene/intersect/box.h"
#include "scene/intersect/embree.h"
#include "scene/intersect/intersector.h"
#include "scene/scene.h"

namespace bpms {

class TracedScene {
 public:
  TracedScene(const Scene& scene, const IntersectorOptions& options);

  // SurfaceId::geometry. A shape's primitive number is 4 shape + part.
  static constexpr std::uint32_t discs = 0, triangles = 1, ground = 2, shapes = 3;
  static bool is_primitive(const SurfaceId& id) { return id.geometry <= shapes && id.geometry != ground; }

  // A point of a primitive's plane (of a disc, its centre) and its unit normal, which looks to the upper
  // side.
  struct Plane {
    Eigen::Vector3d point;
    Eigen::Vector3d normal;
  };
  SurfaceId id(const embree::Found& found) const;
  Plane plane(const embree::Found& found) const;  // where a disc or triangle was met, in whichever copy
  // A disc's plane and diameter at once: most of what is met are discs.
  Plane disc(const embree::Found& found, const SurfaceId& id, double& extent) const;
  // The upper side's, the same for all copies; of a shape, at the point of it near `position`.
  Eigen::Vector3d normal(const SurfaceId& id, const Eigen::Vector3d& position) const;
  double extent(const SurfaceId& id) const;    // no two of its points are further apart along an axis
  double thinnest(const SurfaceId& id) const;  // a shape's smallest width
  ShapePoint shape_at(const embree::Found& found) const;  // in the world
  // How far a point near the found shape lies outside of one of its parts.
  double shape_offset_of(const embree::Found& found, int part, const Eigen::Vector3d& position) const;
  // A point and a direction of the found copy's prototype, in the world.
  Eigen::Vector3d to_world(const embree::Found& found, const Eigen::Vector3d& point) const;
  // The same for an instance itself.
  Eigen::Vector3d place(std::uint32_t instance, const Eigen::Vector3d& point) const {
    return instances_[instance].position_m + instances_[instance].scale * turn(instance, point);
  }
  Eigen::Vector3d turn(std::uint32_t instance, const Eigen::Vector3d& direction) const {
    return instances_[instance].rotation * direction;
  }
  double scale(std::uint32_t instance) const { return instances_[instance].scale; }
  std::uint32_t plant(std::uint32_t instance) const;
  bool is_terrain(std::uint32_t instance) const { return instance == terrain_; }
  const Prototype& prototype(std::uint32_t instance) const {
    return prototypes_[instances_[instance].prototype];
  }
  bool inside_closed_shape(const Eigen::Vector3d& point) const;

  const embree::Bvh& bvh() const { return top_; }
  const Box& box() const { return box_; }  // of all geometry; x and y of the cell when periodic
  bool instanced() const { return instanced_; }
  std::uint64_t memory_bytes() const;
  std::uint64_t estimated_bytes() const { return estimated_bytes_; }

 private:
  // An instance shifted by whole cells: an Embree instance, or its primitives written out (flat).
  struct Copy {
    std::uint32_t instance = 0;
    std::int16_t cells_x = 0, cells_y = 0;
    std::uint32_t written = embree::none;  // index into written_, or an Embree instance
  };
  // A flat copy. One copy of each instance has all primitives, numbered as the prototype numbers them; the
  // others keep only what reaches into the box.
  struct Written {
    bool whole = true;
    std::vector<std::uint32_t> kept_discs, kept_triangles, kept_shapes;  // when not whole
    const embree::DiscClusters* discs = nullptr;  // warm in the caches where a ray has just met something
    const embree::Shapes* shapes = nullptr;
  };
  // Embree's number of a geometry in the top scene is an index into owners_: copy and kind.
  std::uint32_t owner(const embree::Found& found) const {  // 4 copy + kind
    return owners_[found.instance != embree::none ? found.instance : found.geometry];
  }
  const Copy& copy_of(const embree::Found& found) const { return copies_[owner(found) / 4]; }
  std::uint32_t kind_of(const embree::Found& found) const {
    return found.instance != embree::none ? found.geometry : owner(found) % 4;
  }
  const Written* written_of(const Copy& copy) const {
    return copy.written == embree::none ? nullptr : &written_[copy.written];
  }
  Eigen::Vector3d shift(const Copy& copy) const {
    return {copy.cells_x * size_.x(), copy.cells_y * size_.y(), 0};
  }
  const Shape& shape_of(const Copy& copy, std::uint32_t index) const;
  std::uint32_t new_owner(std::uint32_t copy, std::uint32_t kind);

  static std::uint64_t primitives(const Prototype& prototype);
  bool inside(const Box& b) const;
  void add_terrain(const Terrain& terrain, std::uint32_t material);
  void sort_discs();
  void make_triangle_normals();
  void make_copies(const std::vector<Box>& instance_bounds);
  void choose_layout(const IntersectorOptions& options);
  void estimate(const IntersectorOptions& options);
  void add_flat_discs(std::uint32_t number);
  void add_flat_triangles(std::uint32_t number);
  void add_flat_shapes(std::uint32_t number);
  void add_instance(std::uint32_t number);
  std::unique_ptr<embree::Bvh> prototype_bvh(const Prototype& prototype) const;

  embree::Device device_;
  std::vector<std::unique_ptr<embree::Bvh>> prototype_bvh_;  // null where all instances are flat
  embree::Bvh top_;
  std::vector<Prototype> prototypes_;
  std::vector<std::vector<Eigen::Vector3f>> triangle_normals_;  // of each prototype's mesh, upper side
  std::vector<Instance> instances_;
  std::vector<Copy> copies_;
  std::vector<Written> written_;
  std::vector<std::uint32_t> owners_;
  std::vector<std::uint32_t> whole_copy_;  // of each instance
  std::uint32_t terrain_ = embree::none;   // its instance
  std::uint64_t estimated_bytes_ = 0;
  bool periodic_ = false;
  bool instanced_ = false;
  Eigen::Vector2d size_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d complete_low_ = Eigen::Vector2d::Zero(), complete_high_ = Eigen::Vector2d::Zero();
  Box box_;
};

}  // namespace bpms
