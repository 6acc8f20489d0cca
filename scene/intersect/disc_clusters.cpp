#include "scene/intersect/disc_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/intersect/embree.h"

namespace bpms::embree {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace

DiscClusters::DiscClusters(const std::vector<Disc>& discs) {
  Cluster empty{};
  std::fill(std::begin(empty.nz), std::end(empty.nz), 1.0f);
  std::fill(std::begin(empty.radius2), std::end(empty.radius2), -1.0f);
  clusters_.assign((discs.size() + wide - 1) / wide, empty);
  for (std::size_t k = 0; k < discs.size(); ++k) {
    Cluster& c = clusters_[k / wide];
    const std::size_t i = k % wide;
    const auto& [centre, radius, normal] = discs[k];
    c.x[i] = centre.x(), c.y[i] = centre.y(), c.z[i] = centre.z();
    c.nx[i] = normal.x(), c.ny[i] = normal.y(), c.nz[i] = normal.z();
    c.radius2[i] = radius * radius;
  }
}

Eigen::Vector3d DiscClusters::centre(std::size_t disc) const {
  const Cluster& c = clusters_[disc / wide];
  const std::size_t i = disc % wide;
  return {c.x[i], c.y[i], c.z[i]};
}

Eigen::Vector3d DiscClusters::normal(std::size_t disc) const {
  const Cluster& c = clusters_[disc / wide];
  const std::size_t i = disc % wide;
  return {c.nx[i], c.ny[i], c.nz[i]};
}

double DiscClusters::radius(std::size_t disc) const {
  return std::sqrt(static_cast<double>(clusters_[disc / wide].radius2[disc % wide]));
}

void DiscClusters::bounds(const RTCBoundsFunctionArguments* arguments) {
  const Cluster& c =
      static_cast<const DiscClusters*>(arguments->geometryUserPtr)->clusters_[arguments->primID];
  Eigen::Array3f low = Eigen::Array3f::Constant(infinity), high = -low;
  for (std::size_t i = 0; i < wide; ++i) {
    if (c.radius2[i] < 0) continue;
    const Eigen::Array3f centre(c.x[i], c.y[i], c.z[i]), normal(c.nx[i], c.ny[i], c.nz[i]);
    // Of the place's rounding, and of the normal's: 1 - n^2 is off by 1e-7, its root by up to 1e-3.
    constexpr float hair = 1e-6f, tilt = 1e-3f;
    const Eigen::Array3f half =
        std::sqrt(c.radius2[i]) * ((1 - normal.square()).max(0).sqrt() + tilt) + hair * centre.abs();
    low = low.min(centre - half);
    high = high.max(centre + half);
  }
  RTCBounds& out = *arguments->bounds_o;
  out.lower_x = low.x(), out.lower_y = low.y(), out.lower_z = low.z();
  out.upper_x = high.x(), out.upper_y = high.y(), out.upper_z = high.z();
}

__attribute__((target_clones("arch=x86-64-v3", "default"))) bool DiscClusters::test(const Cluster& c,
                                                                                    const Query& q,
                                                                                    float* t) {
  int any = 0;
  for (std::size_t i = 0; i < wide; ++i) {
    const float px = c.x[i] - q.origin[0], py = c.y[i] - q.origin[1], pz = c.z[i] - q.origin[2];
    const float along = c.nx[i] * q.direction[0] + c.ny[i] * q.direction[1] + c.nz[i] * q.direction[2];
    const float at = (c.nx[i] * px + c.ny[i] * py + c.nz[i] * pz) / along;
    const float x = at * q.direction[0] - px, y = at * q.direction[1] - py, z = at * q.direction[2] - pz;
    const int met = static_cast<int>(x * x + y * y + z * z <= c.radius2[i]) & static_cast<int>(at > q.near) &
                    static_cast<int>(at < q.far);
    t[i] = met != 0 ? at : infinity;
    any |= met;
  }
  return any != 0;
}

void DiscClusters::intersect(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& [ray, hit] = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);  // N = 1: rtcIntersect1 alone is used
  const auto& all = *static_cast<const DiscClusters*>(arguments->geometryUserPtr);
  const Query query{
      {ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, ray.tnear, ray.tfar};
  alignas(32) float t[wide];
  if (!test(all.clusters_[arguments->primID], query, t)) return;
  const std::size_t nearest = static_cast<std::size_t>(std::min_element(t, t + wide) - t);
  const std::size_t disc = arguments->primID * wide + nearest;
  const Eigen::Vector3f normal = all.normal(disc).cast<float>();
  ray.tfar = t[nearest];
  hit.Ng_x = normal.x(), hit.Ng_y = normal.y(), hit.Ng_z = normal.z();
  hit.u = hit.v = 0;
  hit.primID = static_cast<unsigned>(disc);
  hit.geomID = arguments->geomID;
  hit.instID[0] = arguments->context->instID[0];
}

void DiscClusters::occluded(const RTCOccludedFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  RTCRay& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
  const auto& all = *static_cast<const DiscClusters*>(arguments->geometryUserPtr);
  const Query query{
      {ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, ray.tnear, ray.tfar};
  alignas(32) float t[wide];
  if (test(all.clusters_[arguments->primID], query, t)) ray.tfar = -infinity;
}

}  // namespace bpms::embree
