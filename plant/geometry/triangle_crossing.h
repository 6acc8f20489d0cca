// Do two triangles cross?
#pragma once
#include <Eigen/Core>
#include <array>

namespace bpms {
using TriangleCorners = std::array<Eigen::Vector3d, 3>;

// What merely touches (a common edge or corner, or within 1e-4 of the triangles' size) does not cross;
// triangles of one plane that lie over each other do.
bool triangles_cross(const TriangleCorners& a, const TriangleCorners& b);
}  // namespace bpms
