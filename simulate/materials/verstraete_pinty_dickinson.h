// Verstraete, Pinty & Dickinson 1990 and Pinty, Verstraete & Dickinson 1990 (JGR 95:11755, 11767), a thick
// canopy or soil of small scatterers with a hot spot. State 1 is the sun (`light`), 2 the view; they may not
// be exchanged:
//   BRF = (w/4) k1 / (k1 mu2 + k2 mu1) [Pv P(g) + H(mu1/k1) H(mu2/k2) - 1]
//   H(x) = (1 + x) / (1 + x sqrt(1 - w)),  Pv = 1 + 1 / (1 + Vp)
//   Vp = 4 (1 - 4/(3 pi)) mu2 G / (2 r Lambda k2),  k_i = Psi1 + Psi2 mu_i
// w: single scattering albedo, r: radius of the sun flecks (m), Lambda: area of scatterers per volume
// (m2 m-3), P: phase function. The leaf angle parameter chi gives Psi by Goudriaan 1977 or Dickinson 1990.
#pragma once
#include "simulate/materials/formula_lobe.h"
#include "simulate/materials/scattering_phase.h"

namespace bpms {

struct VpdParameters {
  double w = 0, radius_m = 0, density = 0;
  double psi1 = 0.5, psi2 = 0;
  bool multiple = true;  // false: single scattering alone
  ScatteringPhase phase{};
};
double vpd_brf(const VpdParameters& p, const ReflectionAngles& angles);
void set_goudriaan(VpdParameters& p, double chi);  // chi from -0.4 (upright) to 0.6 (level), 0 spherical
void set_dickinson(VpdParameters& p, double chi);

using VpdLobe = ParametricLobe<VpdParameters, vpd_brf, false>;

}  // namespace bpms
