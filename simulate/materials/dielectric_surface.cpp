#include "simulate/materials/dielectric_surface.h"

#include <cmath>

#include "core/units.h"

namespace bpms {

double fresnel_reflectance(double cosine, double n) {
  const double inside = std::sqrt(n * n - 1 + cosine * cosine);  // n times the cosine inside
  const double s = (cosine - inside) / (cosine + inside);
  const double p = (n * n * cosine - inside) / (n * n * cosine + inside);
  return (s * s + p * p) / 2;
}

double cone_transmittance(double cone_rad, double n) {
  if (n == 1) return 1;
  const double n2 = n * n, plus = n2 + 1, minus = n2 - 1;
  const double sine2 = std::sin(cone_rad) * std::sin(cone_rad);
  const double k = -minus * minus / 4;
  const double a = (n + 1) * (n + 1) / 2;
  const double middle = sine2 - plus / 2;
  const bool all = cone_rad >= pi / 2;  // where the root is 0 but for rounding
  const double b = (all ? 0 : std::sqrt(middle * middle + k)) - middle;
  // The two polarisations, each as an integral from a to b.
  const auto s_part = [k](double x) { return k * k / (6 * x * x * x) + k / x - x / 2; };
  const double s = s_part(b) - s_part(a);
  const double da = 2 * plus * a - minus * minus, db = 2 * plus * b - minus * minus;
  const double p = -2 * n2 * (b - a) / (plus * plus) - 2 * n2 * plus * std::log(b / a) / (minus * minus) +
                   n2 * (1 / b - 1 / a) / 2 +
                   16 * n2 * n2 * (n2 * n2 + 1) * std::log(db / da) / (plus * plus * plus * minus * minus) +
                   16 * n2 * n2 * n2 * (1 / db - 1 / da) / (plus * plus * plus);
  return (s + p) / (2 * sine2);
}

}  // namespace bpms
