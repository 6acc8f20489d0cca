// The scene as the intersector traces it: prototypes with their normals, copies of instances over a periodic
// cell, and the hierarchy (BVH) over them, flat where memory allows and instanced where it does not.
//
// A periodic cell is completed with the copies, shifted by whole cells, of everything that crosses its border
// or lies within `margin` outside it: in the box [low - margin, high + margin] x-y the infinite scene is all
// there.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "scene/intersect/embree.h"
#include "scene/intersect/intersector.h"
#include "scene/scene.h"

namespace bpms {

struct Box {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-1e300);
  bool empty() const { return low.x() > high.x(); }
  void include(const Eigen::Vector3d& point) { low = low.cwiseMin(point), high = high.cwiseMax(point); }
};
Box bounds(const Disc& disc);
Box bounds(const Prototype& prototype);
// Encloses the instance: exact in z, and in x and y when it is not turned.
Box bounds(const Box& prototype, const Instance& instance);

class TracedScene {
 public:
  TracedScene(const Scene& scene, const IntersectorOptions& options);

  static constexpr std::uint32_t discs = 0, triangles = 1, ground = 2;  // SurfaceId::geometry

  // What Embree found, named as the scene names it; `shift` places the copy it belongs to.
  struct Element {
    SurfaceId id;
    Eigen::Vector2d shift;
  };
  Element identify(const embree::Found& found) const;

  // A point of the element's plane (not shifted) and its unit normal, which looks to the upper side.
  struct Plane {
    Eigen::Vector3d point;
    Eigen::Vector3d normal;
  };
  Plane plane(const SurfaceId& id) const;
  Eigen::Vector3d normal(const SurfaceId& id) const;
  const Prototype& prototype_of(const SurfaceId& id) const {
    return prototypes_[instances_[id.instance].prototype];
  }
  Eigen::Vector3d to_world(std::uint32_t instance, const Eigen::Vector3f& point) const;
  Eigen::Vector3d turn(std::uint32_t instance, const Eigen::Vector3f& direction) const;

  const embree::Bvh& bvh() const { return top_; }
  const Box& box() const { return box_; }  // of all geometry; x-y of the cell when periodic
  double margin_m() const { return margin_; }
  bool instanced() const { return !copies_.empty(); }
  std::uint64_t memory_bytes() const { return device_.memory_bytes(); }

 private:
  struct Copy {
    std::uint32_t instance;
    std::int32_t shift_x, shift_y;
  };
  struct Flat {
    std::uint32_t instance;
    std::uint32_t primitive;
    std::int16_t shift_x, shift_y;
  };
  struct Rotation {
    double cosine, sine;
  };
  void add_flat(const std::vector<Copy>& copies);
  void add_flat_discs(const std::vector<Copy>& copies);
  void add_flat_triangles(const std::vector<Copy>& copies);
  void add_instanced(const std::vector<Copy>& copies);
  std::vector<Copy> copies_over_cell(const std::vector<Box>& instance_bounds) const;
  bool inside(const Box& b, const Eigen::Vector2d& shift) const;
  Eigen::Vector2d shift(std::int32_t x, std::int32_t y) const { return {x * size_.x(), y * size_.y()}; }

  embree::Device device_;
  std::vector<std::unique_ptr<embree::Bvh>> prototype_bvh_;
  embree::Bvh top_;
  std::vector<Prototype> prototypes_;
  std::vector<std::vector<Eigen::Vector3f>> triangle_normals_;  // of each prototype's mesh, upper side
  std::vector<Instance> instances_;
  std::vector<Rotation> rotations_;
  std::vector<Flat> flat_discs_, flat_triangles_;
  std::vector<Copy> copies_;  // instanced ones; geometry number in the top scene = index + first_instance
  static constexpr std::uint32_t first_instance = 2;
  bool periodic_ = false;
  Eigen::Vector2d size_ = Eigen::Vector2d::Zero();
  double margin_ = 0;
  Eigen::Vector2d complete_low_, complete_high_;
  Box box_;
};

}  // namespace bpms
