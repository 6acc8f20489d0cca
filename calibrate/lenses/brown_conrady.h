// Brown-Conrady lens in OpenCV's order of parameters, written once for double and for automatic derivatives.
//   x = X/Z, y = Y/Z, s = x^2 + y^2, radial = (1 + k1 s + k2 s^2 + k3 s^3) / (1 + k4 s + k5 s^2 + k6 s^3)
//   x' = x radial + 2 p1 x y + p2 (s + 2 x^2),  y' = y radial + p1 (s + 2 y^2) + 2 p2 x y
//   u = fx x' + cx,  v = fy y' + cy
// Brown 1966, Conrady 1919; the rational form is OpenCV's. Pixel centres are integers.
#pragma once
#include <Eigen/Core>
#include <optional>

#include "calibrate/lenses/lens.h"

namespace bpms::brown_conrady {

// parameters: fx fy cx cy [k1 k2 p1 p2 [k3 [k4 k5 k6]]]; count 4, 8, 9 or 12.
constexpr bool known_count(int count) {
  return count == 4 || count == 8 || count == 9 || count == 12;
}

template <class T>
void distort(const T* parameters, int count, const T& x, const T& y, T& xd, T& yd) {
  xd = x;
  yd = y;
  if (count < 8) return;
  const T *k = parameters + 4, s = x * x + y * y;
  T radial = (k[1] * s + k[0]) * s + 1.0;
  if (count >= 9) radial += k[4] * s * s * s;
  if (count >= 12) radial /= ((k[7] * s + k[6]) * s + k[5]) * s + 1.0;
  xd = x * radial + 2.0 * k[2] * x * y + k[3] * (s + 2.0 * x * x);
  yd = y * radial + k[2] * (s + 2.0 * y * y) + 2.0 * k[3] * x * y;
}

// Pixel of a point in the camera's frame (z > 0 is the caller's business).
template <class T>
void project(const T* parameters, int count, const T* x_cam, T* pixel) {
  T xd, yd;
  distort<T>(parameters, count, x_cam[0] / x_cam[2], x_cam[1] / x_cam[2], xd, yd);
  pixel[0] = parameters[0] * xd + parameters[2];
  pixel[1] = parameters[1] * yd + parameters[3];
}

// True when the radial distortion rises strictly from the axis to the radius x^2 + y^2 = s, with no pole on
// the way: then no two rays up to there share a distorted radius.
bool monotone_up_to(const double* parameters, int count, double s);

}  // namespace bpms::brown_conrady

namespace bpms {
const Lens& brown_conrady_lens();
}
