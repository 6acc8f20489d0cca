#include "simulate/materials/verstraete_pinty_dickinson.h"

#include "core/units.h"
#include "simulate/materials/read_phase.h"
#include "simulate/materials/spectral_sets.h"

namespace bpms {
namespace {

double vpd_multiple(double x, double gamma) {
  return (1 + x) / (1 + x * gamma);
}

}  // namespace

double vpd_brf(const VpdParameters& p, const ReflectionAngles& angles) {
  const double mu1 = angles.mu_light, mu2 = angles.mu_view;
  const double k1 = p.psi1 + p.psi2 * mu1, k2 = p.psi1 + p.psi2 * mu2;
  const double fleck = 4 * (1 - 4 / (3 * pi)) * mu2 * angles.distance / (2 * p.radius_m * p.density * k2);
  const double gamma = std::sqrt(1 - p.w);
  const double multiple = p.multiple ? vpd_multiple(mu1 / k1, gamma) * vpd_multiple(mu2 / k2, gamma) - 1 : 0;
  return p.w / 4 * k1 / (k1 * mu2 + k2 * mu1) *
         ((1 + 1 / (1 + fleck)) * p.phase(angles.cos_phase) + multiple);
}

void set_goudriaan(VpdParameters& p, double chi) {
  p.psi1 = 0.5 - (0.6333 + 0.33 * chi) * chi;
  p.psi2 = 0.877 * (1 - 2 * p.psi1);
}

void set_dickinson(VpdParameters& p, double chi) {
  p.psi1 = 0.5 - (0.489 + 0.11 * chi) * chi;
  p.psi2 = 1 - 2 * p.psi1;
}

Material read_verstraete_pinty_dickinson(const TomlValue& table, MaterialContext& context) {
  Material out = black_material(context.bands(), true);
  const std::vector<double> w = context.spectrum(table.require("w"), 0.0, 1.0);
  VpdParameters common;
  common.radius_m = table.require("sunfleck_radius_m").number(1e-4, 10.0);
  common.density = table.require("area_density_m2_m3").number(1e-3, 1000.0);
  const double chi = table.has("chi") ? table.require("chi").number(-0.4, 0.6) : 0.0;
  const TomlValue kappa = table.get("kappa");
  if ((kappa ? kappa.one_of({"goudriaan", "dickinson"}) : "goudriaan") == "goudriaan")
    set_goudriaan(common, chi);
  else
    set_dickinson(common, chi);
  common.multiple = table.boolean_or("multiple_scattering", true);
  const SpectralPhase phase = read_phase(table, context);
  std::vector<VpdParameters> sets(w.size(), common);
  for (std::size_t band = 0; band < w.size(); ++band) {
    sets[band].w = w[band];
    sets[band].phase = phase.at(band);
  }
  const bool one = all_flat({&w, &phase.asymmetry, &phase.a1, &phase.a2});
  constexpr double exponent = 1.5;  // of the sampler
  out.lobes.push_back(lobe_of_sets<VpdLobe>(table, std::move(sets), one, exponent));
  return out;
}

}  // namespace bpms
