// Do two triangles in space pass through each other? By the signs of volumes: the corners of each lie on both
// sides of the other's plane, and an edge of one goes through the inside of the other (Devillers & Guigue
// 2002 order the same tests). Triangles in one plane, or that touch in a point or along an edge, do not
// cross.
#pragma once
#include <Eigen/Core>
#include <array>

namespace bpms {
using TriangleCorners = std::array<Eigen::Vector3d, 3>;
bool triangles_cross(const TriangleCorners& a, const TriangleCorners& b);
}  // namespace bpms
