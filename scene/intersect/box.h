// Axis-aligned boxes around discs, shapes, prototypes and their instances.
#pragma once
#include <Eigen/Core>

#include "scene/scene.h"

namespace bpms {

struct Box {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-1e300);
  bool empty() const { return low.x() > high.x(); }
  void include(const Eigen::Vector3d& point) { low = low.cwiseMin(point), high = high.cwiseMax(point); }
  void include(const Box& other) { low = low.cwiseMin(other.low), high = high.cwiseMax(other.high); }
};
Box bounds(const Disc& disc);
Box bounds(const Shape& shape);
Box bounds(const Prototype& prototype);
// Encloses an instance: exact in z when it stands upright, and in x and y too when it is not turned at all.
Box bounds(const Box& prototype, const Instance& instance);

}  // namespace bpms
