#include "plant/canopy/plant_shape.h"

#include <algorithm>
#include <numeric>

namespace bpms {
namespace {

constexpr std::uint32_t triangles_a_run = 8;

BoundSphere sphere_around(const TriangleCorners* first, std::size_t count) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < count; ++i)
    for (const Eigen::Vector3d& corner : first[i]) box.extend(corner);
  BoundSphere out{box.center(), 0};
  for (std::size_t i = 0; i < count; ++i)
    for (const Eigen::Vector3d& corner : first[i])
      out.radius = std::max(out.radius, (corner - out.centre).norm());
  return out;
}

// Which triangles of two plants cross: marks those of a in one list, those of b in the other.
class CrossingPair {
 public:
  CrossingPair(const PlacedShape& a, const PlacedShape& b, std::vector<char>& of_a, std::vector<char>& of_b)
      : a_(a), b_(b), of_a_(of_a), of_b_(of_b) {}
  void mark() {
    const BoundSphere whole_b = b_.sphere(b_.shape->sphere), whole_a = a_.sphere(a_.shape->sphere);
    std::vector<NearOrgan> organs_b;
    for (const OrganShape& organ : b_.shape->organs) {
      const BoundSphere sphere = b_.sphere(organ.sphere);
      if (sphere.meets(whole_a)) organs_b.push_back({sphere, &organ});
    }
    for (const OrganShape& organ_a : a_.shape->organs) {
      if (organs_b.empty()) return;
      const BoundSphere sphere_a = a_.sphere(organ_a.sphere);
      if (!sphere_a.meets(whole_b)) continue;
      for (const NearOrgan& b : organs_b)
        if ((organ_a.leaf || b.organ->leaf) && sphere_a.meets(b.sphere))
          mark_organs(organ_a, *b.organ, sphere_a, b.sphere);
    }
  }

 private:
  void mark_organs(const OrganShape& organ_a, const OrganShape& organ_b, const BoundSphere& sphere_a,
                   const BoundSphere& sphere_b) {
    near_b_.clear();
    for (std::uint32_t j = 0; j < organ_b.count; ++j) {
      const TriangleRun& run_b = b_.shape->runs[organ_b.first + j];
      const BoundSphere around_b = b_.sphere(run_b.sphere);
      if (around_b.meets(sphere_a)) near_b_.push_back({around_b, &run_b});
    }
    for (std::uint32_t i = 0; i < organ_a.count && !near_b_.empty(); ++i) {
      const TriangleRun& run_a = a_.shape->runs[organ_a.first + i];
      const BoundSphere around_a = a_.sphere(run_a.sphere);
      if (!around_a.meets(sphere_b)) continue;
      for (const NearRun& near : near_b_)
        if (around_a.meets(near.sphere)) mark_runs(run_a, *near.run);
    }
  }
  void mark_runs(const TriangleRun& run_a, const TriangleRun& run_b) {
    TriangleCorners triangles_b[triangles_a_run];
    for (std::uint32_t j = 0; j < run_b.count; ++j) triangles_b[j] = b_.triangle(run_b.first + j);
    for (std::uint32_t i = run_a.first; i < run_a.first + run_a.count; ++i) {
      const TriangleCorners triangle_a = a_.triangle(i);
      for (std::uint32_t j = 0; j < run_b.count; ++j) {
        if (of_a_[i] != 0 && of_b_[run_b.first + j] != 0) continue;
        if (triangles_cross(triangle_a, triangles_b[j])) of_a_[i] = of_b_[run_b.first + j] = 1;
      }
    }
  }
  struct NearOrgan {
    BoundSphere sphere;
    const OrganShape* organ = nullptr;
  };
  struct NearRun {
    BoundSphere sphere;
    const TriangleRun* run = nullptr;
  };
  const PlacedShape &a_, &b_;
  std::vector<char>&of_a_, &of_b_;
  std::vector<NearRun> near_b_;  // runs of b's organ that reach a's
};

}  // namespace

PlantShape plant_shape(const Mesh& mesh) {
  PlantShape out;
  std::vector<std::uint32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return mesh.organ_of_triangle[a] < mesh.organ_of_triangle[b];
  });
  for (const std::uint32_t t : order) {
    TriangleCorners corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.positions_m[mesh.triangles[t][k]].cast<double>();
    out.triangles.push_back(corners);
    out.area_m2.push_back(0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm());
  }
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    const std::uint32_t organ = mesh.organ_of_triangle[order[begin]];
    while (end < order.size() && mesh.organ_of_triangle[order[end]] == organ) ++end;
    OrganShape shape{sphere_around(&out.triangles[begin], end - begin), mesh.organs[organ].kind == "leaf",
                     static_cast<std::uint32_t>(out.runs.size()), 0};
    for (std::size_t at = begin; at < end; at += triangles_a_run) {
      const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(triangles_a_run, end - at));
      out.runs.push_back({sphere_around(&out.triangles[at], count), static_cast<std::uint32_t>(at), count});
      ++shape.count;
    }
    for (std::size_t t = begin; t < end && shape.leaf; ++t) out.leaf_area_m2 += out.area_m2[t];
    out.organs.push_back(shape);
  }
  if (!out.triangles.empty()) out.sphere = sphere_around(out.triangles.data(), out.triangles.size());
  return out;
}

void mark_crossing(const PlacedShape& a, const PlacedShape& b, std::vector<char>& of_a,
                   std::vector<char>& of_b) {
  CrossingPair(a, b, of_a, of_b).mark();
}

double marked_leaf_area_m2(const PlacedShape& of, const std::vector<char>& marked) {
  double out = 0;
  for (const OrganShape& organ : of.shape->organs) {
    if (!organ.leaf) continue;
    const TriangleRun &first = of.shape->runs[organ.first],
                      &last = of.shape->runs[organ.first + organ.count - 1];
    for (std::uint32_t t = first.first; t < last.first + last.count; ++t)
      if (marked[t] != 0) out += of.shape->area_m2[t];
  }
  return out * of.scale * of.scale;
}

}  // namespace bpms
