#include "plant/canopy/clone_variation.h"

#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

constexpr double most_sd = 3;  // normal draws farther out are drawn again

double truncated_normal(Philox& random) {
  double out = random.normal();
  while (std::abs(out) > most_sd) out = random.normal();
  return out;
}

// Best & Fisher 1979, for mean 0.
double von_mises(double kappa, Philox& random) {
  if (kappa < 1e-8) return random.uniform(-pi, pi);
  const double tau = 1 + std::sqrt(1 + 4 * kappa * kappa);
  const double rho = (tau - std::sqrt(2 * tau)) / (2 * kappa);
  const double r = (1 + rho * rho) / (2 * rho);
  for (;;) {
    const double z = std::cos(pi * random.uniform());
    const double f = (1 + r * z) / (r + z);
    const double c = kappa * (r - f);
    const double u = random.uniform();
    if (c * (2 - c) - u > 0 || std::log(c / u) + 1 - c >= 0)
      return (random.uniform() > 0.5 ? 1 : -1) * std::acos(std::clamp(f, -1.0, 1.0));
  }
}

}  // namespace

CloneVariation::CloneVariation(const TomlValue& plant) {
  if (const TomlValue value = plant.get("scale")) {
    constexpr double largest_scale = 1e6;
    scale_ = positive_mean_sd(value);
    if (scale_.mean > largest_scale) value.reject("expected a factor up to 1e6");
    if (scale_.mean - most_sd * scale_.sd <= 0)
      value.reject(fmt::format("mean {} and sd {} reach zero within {} sd", scale_.mean, scale_.sd, most_sd));
  }
  const TomlValue value = plant.get("rotation");
  if (!value) return;
  const std::string type = value.require("type").one_of({"uniform", "fixed", "von_mises"});
  if (type == "fixed") {
    type_ = Rotation::fixed;
    angle_ = radians(value.require("deg").number());
  } else if (type == "von_mises") {
    constexpr double most_kappa = 1e6;
    type_ = Rotation::von_mises;
    angle_ = radians(value.require("mean_deg").number());
    kappa_ = value.require("kappa").number(0, most_kappa);
  }
}

double CloneVariation::rotation(Philox& random) const {
  if (type_ == Rotation::fixed) return angle_;
  if (type_ == Rotation::uniform) return random.uniform(0, 2 * pi);
  return angle_ + von_mises(kappa_, random);
}

double CloneVariation::scale(Philox& random) const {
  return scale_.sd > 0 ? scale_.mean + scale_.sd * truncated_normal(random) : scale_.mean;
}

}  // namespace bpms
