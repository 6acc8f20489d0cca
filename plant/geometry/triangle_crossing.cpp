#include "plant/geometry/triangle_crossing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bpms {
namespace {

// A little smaller, so that what touches is apart.
TriangleCorners shrunk(const TriangleCorners& t) {
  constexpr double by = 1e-4;
  const Eigen::Vector3d middle = (t[0] + t[1] + t[2]) / 3;
  return {t[0] + by * (middle - t[0]), t[1] + by * (middle - t[1]), t[2] + by * (middle - t[2])};
}

// Does the stretch from p to q go through the triangle (Moller and Trumbore 1997)?
bool goes_through(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const TriangleCorners& t) {
  const Eigen::Vector3d d = q - p, e1 = t[1] - t[0], e2 = t[2] - t[0], h = d.cross(e2);
  const double determinant = e1.dot(h);
  if (determinant == 0) return false;
  const Eigen::Vector3d s = p - t[0], k = s.cross(e1);
  const double u = s.dot(h) / determinant, v = d.dot(k) / determinant, along = e2.dot(k) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && along >= 0 && along <= 1;
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

bool triangles_cross(const TriangleCorners& first, const TriangleCorners& second) {
  const TriangleCorners a = shrunk(first), b = shrunk(second);
  const Eigen::Vector3d normal = (a[1] - a[0]).cross(a[2] - a[0]);
  const double twice_area = normal.norm();
  if (!(twice_area > 0)) return false;
  double lowest = std::numeric_limits<double>::infinity(),
         highest = -lowest;  // of b's corners over a's plane
  for (const Eigen::Vector3d& corner : b) {
    const double height = (corner - a[0]).dot(normal) / twice_area;
    lowest = std::min(lowest, height), highest = std::max(highest, height);
  }
  constexpr double flat = 1e-5;
  const double nearest = std::min(0.0, lowest), farthest = std::max(0.0, highest);
  if (farthest - nearest < flat * std::sqrt(twice_area)) return overlap_in_plane(a, b, normal / twice_area);
  if (lowest > 0 || highest < 0) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (goes_through(a[k], a[(k + 1) % 3], b) || goes_through(b[k], b[(k + 1) % 3], a)) return true;
  }
  return false;
}

}  // namespace bpms
