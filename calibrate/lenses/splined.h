// A lens as a surface: corrections of the stereographic projection by B-splines over a grid of knots, for
// lenses that no formula fits. The numbers are those of mrcal's LENSMODEL_SPLINED_STEREOGRAPHIC:
//   u = 2 (X, Y) / (|X| + Z) = 2 tan(theta/2) along the direction from the axis
//   pixel = f (u + delta(u)) + c, delta a uniform B-spline surface of the given order (2 or 3)
// Parameters fx fy cx cy, then delta x and y of each knot, row by row. Constants: order, columns, rows,
// fov_x_deg: the surface spans that field across; knots are h apart both ways, h = 2 (2 tan(fov_x/4)) /
// (columns - order), the grid's middle on the axis, and defined where all knots of the basis exist.
#pragma once
#include "calibrate/lenses/lens.h"
#include "calibrate/rig.h"

namespace bpms {

const Lens& splined_lens();
constexpr int splined_parameters(int columns, int rows) {
  return 4 + 2 * columns * rows;
}
// The constants with a field of view that covers the camera's image.
std::vector<double> splined_constants(const Camera& camera, std::vector<double> constants);

}  // namespace bpms
