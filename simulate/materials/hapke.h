// Hapke 1981 (JGR 86:3039), bidirectional reflectance of a thick layer of grains:
//   BRF = (w/4) / (mu + mu0) {[1 + B(g)] P(g) + H(mu) H(mu0) - 1}
//   H(x) = (1 + 2x) / (1 + 2x sqrt(1 - w)),  B(g) = B0 / (1 + tan(g/2) / h)
// w: single scattering albedo, B0: height and h: width of the hot spot, P: phase function. Reciprocal.
#pragma once
#include "simulate/materials/formula_lobe.h"
#include "simulate/materials/scattering_phase.h"

namespace bpms {

struct HapkeParameters {
  double w, b0, h;
  ScatteringPhase phase;
};
double hapke_brf(const HapkeParameters& p, const ReflectionAngles& angles);

using HapkeLobe = ParametricLobe<HapkeParameters, hapke_brf>;

}  // namespace bpms
