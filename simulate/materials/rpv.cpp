#include "simulate/materials/rpv.h"

#include "simulate/materials/material.h"
#include "simulate/materials/spectral_sets.h"

namespace bpms {
namespace {

// Towards the horizon BRF times cosine goes as cosine^k.
double rpv_exponent(const std::vector<RpvParameters>& parameters) {
  double least = 1;
  for (const RpvParameters& p : parameters) least = std::min(least, p.k);
  return 1 + std::max(least, 0.05);
}

}  // namespace

double rpv_brf(const RpvParameters& p, const ReflectionAngles& angles) {
  const double bowl = angles.mu_view * angles.mu_light * (angles.mu_view + angles.mu_light);
  const double phase = 1 + 2 * p.theta * angles.cos_phase + p.theta * p.theta;
  return p.rho0 * std::pow(bowl, p.k - 1) * (1 - p.theta * p.theta) / (phase * std::sqrt(phase)) *
         (1 + (1 - p.rhoc) / (1 + angles.distance));
}

Material read_rpv(const TomlValue& table, MaterialContext& context) {
  Material out = black_material(context.bands(), true);
  const std::vector<double> rho0 = context.spectrum(table.require("rho0"), 0.0, 2.0);
  const std::vector<double> k = context.spectrum(table.require("k"), 0.0, 3.0);
  const std::vector<double> theta = context.spectrum(table.require("theta"), -0.95, 0.95);
  const TomlValue hot_spot = table.get("rhoc");
  const std::vector<double> rhoc = hot_spot ? context.spectrum(hot_spot, 0.0, 2.0) : rho0;
  SurfaceLobe lobe;
  lobe.on_face = read_faces(table);
  const bool one = all_flat({&k, &theta, &rhoc});
  std::vector<RpvParameters> sets;
  for (std::size_t band = 0; band < (one ? 1 : rho0.size()); ++band)
    sets.push_back({one ? 1.0 : rho0[band], k[band], theta[band], rhoc[band]});
  if (one) lobe.spectrum = rho0;
  const double exponent = rpv_exponent(sets);
  lobe.lobe = std::make_shared<RpvLobe>(std::move(sets), one, exponent);
  out.lobes.push_back(std::move(lobe));
  return out;
}

}  // namespace bpms
