// Shapes with a formula (scene/geometry/shape.h) as Embree's user geometry, one to a primitive, met in double
// precision.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "scene/geometry/shape.h"

struct RTCBoundsFunctionArguments;
struct RTCIntersectFunctionNArguments;
struct RTCOccludedFunctionNArguments;

namespace bpms::embree {

class Shapes {
 public:
  explicit Shapes(std::vector<Shape> shapes) : shapes_(std::move(shapes)) {}
  std::size_t size() const { return shapes_.size(); }
  const Shape& operator[](std::size_t shape) const { return shapes_[shape]; }
  std::uint64_t memory_bytes() const { return shapes_.size() * sizeof(Shape); }

  // Embree's callbacks; `geometryUserPtr` is the Shapes. A hit's primID is 4 shape + part, its Ng the
  // crossing's place in the shape's frame.
  static void bounds(const RTCBoundsFunctionArguments* arguments);
  static void intersect(const RTCIntersectFunctionNArguments* arguments);
  static void occluded(const RTCOccludedFunctionNArguments* arguments);

 private:
  std::vector<Shape> shapes_;
};

}  // namespace bpms::embree
