#include "plant/structure/ellipsoidal.h"

#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

double ellipsoid_lambda(double chi) {
  const double e2 = chi < 1 ? 1 - chi * chi : 1 - 1 / (chi * chi);
  constexpr double near_sphere = 1e-8;
  if (e2 < near_sphere) return chi + 1;
  const double e = std::sqrt(e2);
  return chi < 1 ? chi + std::asin(e) / e : chi + std::log((1 + e) / (1 - e)) / (2 * e * chi);
}

constexpr double least_chi = 1e-3, most_chi = 1e3;

}  // namespace

double ellipsoidal_density(double chi, double t) {
  const double c = std::cos(t), s = std::sin(t);
  const double q = c * c + chi * chi * s * s;
  return 2 * chi * chi * chi * s / (ellipsoid_lambda(chi) * q * q);
}

double ellipsoidal_g(double chi, double zenith) {
  return std::hypot(chi * std::cos(zenith), std::sin(zenith)) / ellipsoid_lambda(chi);
}

double ellipsoidal_mean(double chi) {
  // Over the angle p on the generating circle, tan t = tan p / chi: the integrand then is smooth for any chi.
  // The density of area over it is sin p sqrt(cos^2 p chi^2 + sin^2 p) up to its normalisation.
  constexpr int steps = 2000;
  double sum = 0, weights = 0;
  for (int i = 0; i < steps; ++i) {
    const double p = (i + 0.5) * pi / 2 / steps;
    const double weight = std::sin(p) * std::hypot(chi * std::cos(p), std::sin(p));
    sum += weight * std::atan2(std::sin(p), chi * std::cos(p));
    weights += weight;
  }
  return sum / weights;
}

double ellipsoidal_chi(double mean_inclination) {
  double low = std::log(least_chi), high = std::log(most_chi);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (ellipsoidal_mean(std::exp(middle)) > mean_inclination ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace bpms
