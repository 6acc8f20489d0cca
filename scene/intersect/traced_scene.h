// The scene as the intersector traces it: prototypes with their normals, copies of instances over a periodic
// cell, and the hierarchy (BVH) over them.
//
// A periodic cell is completed with the copies, shifted by whole cells, of everything that crosses its
// border. (A wider margin of copies, which saves rays their change of sides, was tried: no faster on HET01
// and a thin layer.) Instances and triangles are numbered as in the Scene, discs by clusters.
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

  static constexpr std::uint32_t discs = 0, triangles = 1, ground = 2;  // SurfaceId::geometry

  // A point of a primitive's plane (of a disc, its centre) and its unit normal, which looks to the upper
  // side.
  struct Plane {
    Eigen::Vector3d point;
    Eigen::Vector3d normal;
  };
  SurfaceId id(const embree::Found& found) const;
  Plane plane(const embree::Found& found) const;      // where it was met, in whichever copy
  Eigen::Vector3d normal(const SurfaceId& id) const;  // the same for all copies
  double extent(const SurfaceId& id) const;           // no two of its points are further apart along an axis
  // A point and a direction of the found copy's prototype, in the world.
  Eigen::Vector3d to_world(const embree::Found& found, const Eigen::Vector3f& point) const;
  // The same for an instance itself.
  Eigen::Vector3d place(std::uint32_t instance, const Eigen::Vector3f& point) const;
  Eigen::Vector3d turn(std::uint32_t instance, const Eigen::Vector3f& direction) const;
  const Prototype& prototype(std::uint32_t instance) const {
    return prototypes_[instances_[instance].prototype];
  }

  const embree::Bvh& bvh() const { return top_; }
  const Box& box() const { return box_; }  // of all geometry; x and y of the cell when periodic
  bool instanced() const { return instanced_; }
  std::uint64_t memory_bytes() const;

 private:
  // An instance shifted by whole cells: an Embree instance, or its primitives written out (flat). Its numbers
  // in the top scene are 2 copy + discs or triangles. One copy of each instance has all primitives, numbered
  // as the prototype numbers them; the other flat ones keep only what reaches into the box.
  struct Copy {
    std::uint32_t instance = 0;
    Eigen::Vector2d shift = Eigen::Vector2d::Zero();
    bool flat = false;
    bool whole = true;
    std::vector<std::uint32_t> kept_discs, kept_triangles;  // when not whole
    // When flat: warm in the caches where a ray has just met something.
    const embree::DiscClusters* discs = nullptr;
  };
  struct Rotation {
    double cosine, sine;
  };
  const Copy& copy_of(const embree::Found& found) const {
    return copies_[(found.instance != embree::none ? found.instance : found.geometry) / 2];
  }
  static std::uint32_t kind_of(const embree::Found& found) { return found.geometry & 1u; }
  std::uint64_t primitives(std::uint32_t prototype) const;
  bool inside(const Box& b, const Eigen::Vector2d& shift) const;
  void sort_discs();
  void make_triangle_normals();
  void make_copies(const std::vector<Box>& instance_bounds);
  void choose_layout(const IntersectorOptions& options);
  void add_flat_discs(std::uint32_t number);
  void add_flat_triangles(std::uint32_t number);
  void add_instance(std::uint32_t number);
  std::unique_ptr<embree::Bvh> prototype_bvh(const Prototype& prototype) const;

  embree::Device device_;
  std::vector<std::unique_ptr<embree::Bvh>> prototype_bvh_;  // null where all instances are flat
  embree::Bvh top_;
  std::vector<Prototype> prototypes_;
  std::vector<std::vector<Eigen::Vector3f>> triangle_normals_;  // of each prototype's mesh, upper side
  std::vector<Instance> instances_;
  std::vector<Rotation> rotations_;
  std::vector<Copy> copies_;
  std::vector<std::uint32_t> whole_copy_;  // of each instance
  bool periodic_ = false;
  bool instanced_ = false;
  Eigen::Vector2d size_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d complete_low_ = Eigen::Vector2d::Zero(), complete_high_ = Eigen::Vector2d::Zero();
  Box box_;
};

}  // namespace bpms
