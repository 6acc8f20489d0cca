// Embree 3 or 4 behind a few calls: the one place that knows which of them it is.
// A BVH holds discs, triangles, shapes and instances of other BVHs (one level). Closest hit and any hit in
// [near, far].
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "scene/intersect/disc_clusters.h"
#include "scene/intersect/shapes.h"

#if __has_include(<embree4/rtcore.h>) && !__has_include(<embree3/rtcore.h>)
#include <embree4/rtcore.h>
#define BPMS_EMBREE 4
#else
#include <embree3/rtcore.h>
#define BPMS_EMBREE 3
#endif

namespace bpms::embree {

// Flushes denormals in the calling thread, as Embree asks for; cheap when it is done already.
void prepare_thread();

// A device that counts its memory and throws bpms::Error where Embree only sets an error code.
class Device {
 public:
  Device();
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  RTCDevice get() const { return device_; }
  void check(const char* doing) const;
  std::uint64_t memory_bytes() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
  RTCDevice device_ = nullptr;
};

// The linear map from a prototype's frame to the world: uniform scale, rotation, translation.
struct Placement {
  Eigen::Vector3d origin;
  Eigen::Matrix3d turned_and_scaled;
};

// What a ray met: geometry and primitive in the (sub)scene, instance in the top scene or `none`.
inline constexpr std::uint32_t none = RTC_INVALID_GEOMETRY_ID;
struct Found {
  float distance;
  float u, v;
  std::uint32_t geometry;
  std::uint32_t primitive;
  std::uint32_t instance;
  std::array<float, 3> at;  // of a shape: the crossing's place in the shape's frame
};

struct Segment {
  Eigen::Vector3f origin;
  float near;
  Eigen::Vector3f direction;
  float far;
};

class Bvh {
 public:
  explicit Bvh(const Device& device);
  ~Bvh();
  Bvh(const Bvh&) = delete;
  Bvh& operator=(const Bvh&) = delete;

  // Geometry numbers are given by the caller. Triangles: buffers to be filled.
  struct Triangles {
    std::span<std::array<float, 3>> vertex;
    std::span<std::array<std::uint32_t, 3>> index;
  };
  const DiscClusters& add_discs(std::uint32_t geometry, const std::vector<Disc>& discs);
  void add_triangles(std::uint32_t geometry, std::size_t vertices, std::size_t triangles,
                     const std::function<void(const Triangles&)>& fill);
  const Shapes& add_shapes(std::uint32_t geometry, std::vector<Shape> shapes);
  void add_instance(std::uint32_t geometry, const Bvh& prototype, const Placement& placement);
  void commit();

  bool intersect(const Segment& segment, Found& found) const;
  bool occluded(const Segment& segment) const;
  RTCScene get() const { return scene_; }
  std::uint64_t own_bytes() const;  // of discs and shapes, which the device does not count

 private:
  void attach(RTCGeometry geometry, std::uint32_t id);
  const Device& device_;
  RTCScene scene_ = nullptr;
  template <class Primitives>
  void attach_user(Primitives& all, std::size_t count, std::uint32_t id);
  std::vector<std::unique_ptr<DiscClusters>> discs_;
  std::vector<std::unique_ptr<Shapes>> shapes_;
};

inline RTCRay to_ray(const Segment& s) {
  RTCRay ray;
  ray.org_x = s.origin.x(), ray.org_y = s.origin.y(), ray.org_z = s.origin.z();
  ray.tnear = s.near;
  ray.dir_x = s.direction.x(), ray.dir_y = s.direction.y(), ray.dir_z = s.direction.z();
  ray.time = 0;
  ray.tfar = s.far;
  ray.mask = 0xffffffffu;
  ray.id = 0;
  ray.flags = 0;
  return ray;
}

inline bool Bvh::intersect(const Segment& segment, Found& found) const {
  RTCRayHit both;
  both.ray = to_ray(segment);
  both.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  both.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if BPMS_EMBREE == 3
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_, &context, &both);
#else
  rtcIntersect1(scene_, &both);
#endif
  if (both.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  found = {both.ray.tfar,
           both.hit.u,
           both.hit.v,
           both.hit.geomID,
           both.hit.primID,
           both.hit.instID[0],
           {both.hit.Ng_x, both.hit.Ng_y, both.hit.Ng_z}};
  return true;
}

inline bool Bvh::occluded(const Segment& segment) const {
  RTCRay ray = to_ray(segment);
#if BPMS_EMBREE == 3
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_, &context, &ray);
#else
  rtcOccluded1(scene_, &ray);
#endif
  return ray.tfar < 0;  // Embree sets it to -inf
}

}  // namespace bpms::embree
