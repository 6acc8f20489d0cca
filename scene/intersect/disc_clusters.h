// Discs as Embree's user geometry, eight to a primitive, tested at once. Embree's own discs are bounded as
// spheres and fetched one by one: on the homogeneous disc canopy, rays in all directions take some 1.4 times
// as long with them. The caller puts the discs in an order in which neighbours are near (cluster_order.h).
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

struct RTCBoundsFunctionArguments;
struct RTCIntersectFunctionNArguments;
struct RTCOccludedFunctionNArguments;

namespace bpms::embree {

class DiscClusters {
 public:
  static constexpr std::size_t wide = 8;

  explicit DiscClusters(const std::vector<Disc>& discs);  // unit normals
  std::size_t clusters() const { return clusters_.size(); }
  Eigen::Vector3d centre(std::size_t disc) const;
  Eigen::Vector3d normal(std::size_t disc) const;
  double radius(std::size_t disc) const;
  std::uint64_t memory_bytes() const { return clusters_.size() * sizeof(Cluster); }

  // Embree's callbacks; `geometryUserPtr` is the DiscClusters. A hit's primID is the number of the disc.
  static void bounds(const RTCBoundsFunctionArguments* arguments);
  static void intersect(const RTCIntersectFunctionNArguments* arguments);
  static void occluded(const RTCOccludedFunctionNArguments* arguments);

 private:
  struct alignas(32) Cluster {  // by component; empty places have a negative squared radius
    float x[wide], y[wide], z[wide], nx[wide], ny[wide], nz[wide], radius2[wide];
  };
  struct Query {  // a ray
    float origin[3], direction[3], near, far;
  };
  // Is any disc met? t[i]: where along the ray disc i is, in (near, far), or infinity.
  static bool test(const Cluster& cluster, const Query& query, float* t);

  std::vector<Cluster> clusters_;
};

}  // namespace bpms::embree
