#include "simulate/materials/hapke.h"

#include "simulate/materials/read_phase.h"
#include "simulate/materials/spectral_sets.h"

namespace bpms {
namespace {

double hapke_multiple(double x, double gamma) {
  return (1 + 2 * x) / (1 + 2 * x * gamma);
}

}  // namespace

double hapke_brf(const HapkeParameters& p, const ReflectionAngles& angles) {
  const double gamma = std::sqrt(1 - p.w);
  const double half_tangent = std::sqrt((1 - angles.cos_phase) / (1 + angles.cos_phase));  // tan(g/2)
  const double opposition = p.b0 / (1 + half_tangent / p.h);
  return p.w / 4 / (angles.mu_view + angles.mu_light) *
         ((1 + opposition) * p.phase(angles.cos_phase) +
          hapke_multiple(angles.mu_view, gamma) * hapke_multiple(angles.mu_light, gamma) - 1);
}

Material read_hapke(const TomlValue& table, MaterialContext& context) {
  Material out = black_material(context.bands(), true);
  const std::vector<double> w = context.spectrum(table.require("w"), 0.0, 1.0);
  const std::vector<double> b0 = context.spectrum(table.require("b0"), 0.0, 2.0);
  const std::vector<double> h = context.spectrum(table.require("h"), 1e-3, 2.0);
  const SpectralPhase phase = read_phase(table, context);
  std::vector<HapkeParameters> sets;
  for (std::size_t band = 0; band < w.size(); ++band)
    sets.push_back({w[band], b0[band], h[band], phase.at(band)});
  const bool one = all_flat({&w, &b0, &h, &phase.asymmetry, &phase.a1, &phase.a2});
  constexpr double exponent = 1.5;  // of the sampler
  out.lobes.push_back(lobe_of_sets<HapkeLobe>(table, std::move(sets), one, exponent));
  return out;
}

}  // namespace bpms
