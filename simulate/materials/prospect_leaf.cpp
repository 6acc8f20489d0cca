#include "simulate/materials/prospect_leaf.h"

#include <cmath>

#include "core/units.h"
#include "simulate/materials/dielectric_surface.h"
#include "simulate/materials/exponential_integral.h"

namespace bpms {
namespace {

// A plate whose upper side lets in `enter` and lets out `leave` of the light, above a lower side for
// isotropic light: light goes up and down inside, weaker by `through` each time.
PlateOptics one_plate(double enter, double through, double out_isotropic, double inside_reflectance) {
  const double series = 1 - inside_reflectance * inside_reflectance * through * through;
  const double transmittance = enter * through * out_isotropic / series;
  return {1 - enter + inside_reflectance * through * transmittance, transmittance};
}

// `layers` plates, also a part of one (Stokes 1862).
PlateOptics stacked(const PlateOptics& plate, double layers) {
  const double r = plate.reflectance, t = plate.transmittance;
  const double absorbed = 1 - r - t;
  // Without absorption the general form is 0/0, and its error at this limit is of the absorption's order.
  if (absorbed < 1e-10) {
    const double passes = t / (t + (1 - t) * layers);
    return {1 - passes, passes};
  }
  if (r <= 0) return {0, std::pow(t, layers)};
  if (t <= 0) return {layers > 0 ? r : 0, layers > 0 ? 0.0 : 1.0};
  const double root = std::sqrt((1 + r + t) * (1 + r - t) * (1 - r + t) * absorbed);
  const double a = (1 + r * r - t * t + root) / (2 * r), b = (1 - r * r + t * t + root) / (2 * t);
  // Powers of b < 1, which do not overflow for black leaves.
  const double fade = std::pow(b, -layers), fade2 = fade * fade;
  const double whole = a * a - fade2;
  return {a * (1 - fade2) / whole, fade * (a * a - 1) / whole};
}

}  // namespace

double plate_transmittance(double k) {
  if (!(k > 0)) return 1;
  return (1 - k) * std::exp(-k) + k * k * exponential_integral(k);
}

PlateOptics prospect_leaf(double layers, double n, double k, double cone_rad) {
  const double through = plate_transmittance(k);
  const double enter = cone_transmittance(pi / 2, n);
  const double leave = enter / (n * n);  // from inside, the rest is reflected
  const PlateOptics first = one_plate(cone_transmittance(cone_rad, n), through, leave, 1 - leave);
  const PlateOptics other = one_plate(enter, through, leave, 1 - leave);
  const PlateOptics below = stacked(other, layers - 1);
  const double between = 1 - below.reflectance * other.reflectance;
  return {first.reflectance + first.transmittance * below.reflectance * other.transmittance / between,
          first.transmittance * below.transmittance / between};
}

}  // namespace bpms
