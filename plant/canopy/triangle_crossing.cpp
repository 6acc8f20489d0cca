#include "plant/canopy/triangle_crossing.h"

#include <Eigen/Geometry>

namespace bpms {
namespace {

// Signed distances (times twice the area) of the corners of t from the plane of `of`; false: all on one side.
bool on_both_sides(const TriangleCorners& t, const TriangleCorners& of, double (&side)[3]) {
  const Eigen::Vector3d normal = (of[1] - of[0]).cross(of[2] - of[0]);
  bool above = false, below = false;
  for (int k = 0; k < 3; ++k) {
    side[k] = normal.dot(t[k] - of[0]);
    above |= side[k] > 0;
    below |= side[k] < 0;
  }
  return above && below;
}

double six_volumes(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b) {
  return (q - p).dot((a - p).cross(b - p));
}

// Does an edge of t whose ends lie on both sides of `of` go through its inside?
bool edge_passes(const TriangleCorners& t, const double (&side)[3], const TriangleCorners& of) {
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    if (!(side[k] * side[l] < 0)) continue;
    const double u = six_volumes(t[k], t[l], of[0], of[1]), v = six_volumes(t[k], t[l], of[1], of[2]),
                 w = six_volumes(t[k], t[l], of[2], of[0]);
    if ((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0)) return true;
  }
  return false;
}

}  // namespace

bool triangles_cross(const TriangleCorners& a, const TriangleCorners& b) {
  double side_a[3], side_b[3];
  if (!on_both_sides(a, b, side_a) || !on_both_sides(b, a, side_b)) return false;
  return edge_passes(a, side_a, b) || edge_passes(b, side_b, a);
}

}  // namespace bpms
