#include "plant/geometry/surface_crossing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bpms {
namespace {

// A little smaller, so that what touches is apart.
TriangleCorners shrunk(const TriangleCorners& t) {
  constexpr double by = 1e-4;
  const Eigen::Vector3d middle = (t[0] + t[1] + t[2]) / 3;
  return {t[0] + by * (middle - t[0]), t[1] + by * (middle - t[1]), t[2] + by * (middle - t[2])};
}

// Two triangles of one plane: no side of either has the other wholly beyond it.
bool overlap_in_plane(const TriangleCorners& a, const TriangleCorners& b, const Eigen::Vector3d& normal) {
  for (const auto* sides : {&a, &b}) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = normal.cross((*sides)[(k + 1) % 3] - (*sides)[k]);
      const auto range = [&](const TriangleCorners& t) {
        return std::minmax({t[0].dot(axis), t[1].dot(axis), t[2].dot(axis)});
      };
      const auto of_a = range(a), of_b = range(b);
      if (of_a.second <= of_b.first || of_b.second <= of_a.first) return false;
    }
  }
  return true;
}

}  // namespace

bool surfaces_cross(const TriangleCorners& first, const TriangleCorners& second) {
  const TriangleCorners a = shrunk(first), b = shrunk(second);
  const Eigen::Vector3d normal = (a[1] - a[0]).cross(a[2] - a[0]);
  const double twice_area = normal.norm();
  if (!(twice_area > 0)) return false;
  double nearest = 0, farthest = 0;  // of b's corners from a's plane, signed
  for (const Eigen::Vector3d& corner : b) {
    const double height = (corner - a[0]).dot(normal) / twice_area;
    nearest = std::min(nearest, height), farthest = std::max(farthest, height);
  }
  constexpr double flat = 1e-5;
  if (farthest - nearest < flat * std::sqrt(twice_area)) return overlap_in_plane(a, b, normal / twice_area);
  return triangles_cross(a, b);
}

}  // namespace bpms
