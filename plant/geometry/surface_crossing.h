// Do two triangles of surfaces cross? What merely touches (a common edge or corner, or within 1e-4 of the
// triangles' size) does not; triangles of one plane that lie over each other do.
#pragma once
#include "plant/canopy/triangle_crossing.h"

namespace bpms {
bool surfaces_cross(const TriangleCorners& a, const TriangleCorners& b);
}  // namespace bpms
