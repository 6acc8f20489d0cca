// Bicubic Bezier patches S(u, v) = sum B_i(u) B_j(v) P_ij (Bezier 1968; Farin, Curves and Surfaces for CAGD),
// diced into triangles that stay within a tolerance of the surface. U runs over the rows of control points, V
// along them; the upper side is the one that S_u x S_v looks to.
//
// How finely an edge is cut depends on its four control points alone, and both sides compute the same points
// whichever way they run along it: patches with an edge curve in common meet without a crack.
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "plant/mesh.h"

namespace bpms {

using BezierPatch = std::array<Eigen::Vector3d, 16>;  // P_ij at 4 i + j

struct PatchPoint {
  Eigen::Vector3d position, du, dv;
  Eigen::Vector3d normal;  // unit; where the patch is pinched, of the points beside it
};
PatchPoint patch_point(const BezierPatch& patch, double u, double v);

// Triangles with the surface's own normals and (U,V) at their corners, one organ a patch; none of a triangle
// is further than `tolerance_m` from where its (U,V) lie on the surface.
Mesh dice_patches(const std::vector<BezierPatch>& patches, double tolerance_m);
// A sensible tolerance: 1/2000 of the diagonal of the box around the control points.
double usual_patch_tolerance_m(const std::vector<BezierPatch>& patches);

}  // namespace bpms
