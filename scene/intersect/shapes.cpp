#include "scene/intersect/shapes.h"

#include <limits>

#include "scene/intersect/embree.h"

namespace bpms::embree {
namespace {

// The first crossing within the ray's (near, far).
bool first_crossing(const Shape& shape, const RTCRay& ray, ShapeCrossing& out) {
  std::array<ShapeCrossing, 2> crossings;
  const int count =
      shape_crossings(shape, {ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, crossings);
  for (int k = 0; k < count; ++k) {
    const ShapeCrossing& c = crossings[static_cast<std::size_t>(k)];
    const auto t = static_cast<float>(c.t);
    if (t > ray.tnear && t < ray.tfar) {
      out = c;
      return true;
    }
  }
  return false;
}

}  // namespace

void Shapes::bounds(const RTCBoundsFunctionArguments* arguments) {
  const Shape& shape = static_cast<const Shapes*>(arguments->geometryUserPtr)->shapes_[arguments->primID];
  Eigen::Vector3d middle, half;
  shape_box(shape, middle, half);
  constexpr double hair = 1e-6;  // some float steps
  half.array() += hair * (middle.array().abs() + half.array());
  const Eigen::Vector3f low = (middle - half).cast<float>(), high = (middle + half).cast<float>();
  RTCBounds& out = *arguments->bounds_o;
  out.lower_x = low.x(), out.lower_y = low.y(), out.lower_z = low.z();
  out.upper_x = high.x(), out.upper_y = high.y(), out.upper_z = high.z();
}

void Shapes::intersect(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& [ray, hit] = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);  // N = 1: rtcIntersect1 alone is used
  const auto& all = *static_cast<const Shapes*>(arguments->geometryUserPtr);
  ShapeCrossing met;
  if (!first_crossing(all.shapes_[arguments->primID], ray, met)) return;
  ray.tfar = static_cast<float>(met.t);
  hit.Ng_x = static_cast<float>(met.at.x());
  hit.Ng_y = static_cast<float>(met.at.y());
  hit.Ng_z = static_cast<float>(met.at.z());
  hit.u = hit.v = 0;
  hit.primID = 4 * arguments->primID + static_cast<unsigned>(met.part);
  hit.geomID = arguments->geomID;
  hit.instID[0] = arguments->context->instID[0];
}

void Shapes::occluded(const RTCOccludedFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  RTCRay& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
  const auto& all = *static_cast<const Shapes*>(arguments->geometryUserPtr);
  ShapeCrossing met;
  if (first_crossing(all.shapes_[arguments->primID], ray, met))
    ray.tfar = -std::numeric_limits<float>::infinity();
}

}  // namespace bpms::embree
