#include "plant/structure/beta_angles.h"

#include <cmath>

#include "core/units.h"

namespace bpms {

double beta_angle_density(const BetaAngles& beta, double inclination) {
  const double x = inclination / (pi / 2);
  const double log_b = std::lgamma(beta.mu) + std::lgamma(beta.nu) - std::lgamma(beta.mu + beta.nu);
  return 2 / pi * std::exp((beta.mu - 1) * std::log1p(-x) + (beta.nu - 1) * std::log(x) - log_b);
}

std::optional<BetaAngles> fit_beta_angles(double mean, double sd) {
  const double x = mean / (pi / 2), variance = std::pow(sd / (pi / 2), 2);
  const double most = x * (1 - x);
  if (!(variance > 0) || !(variance < most)) return {};
  const double sum = most / variance - 1;
  return BetaAngles{(1 - x) * sum, x * sum};
}

}  // namespace bpms
