// Rahman, Pinty & Verstraete 1993 (JGR 98:20791), with the hot spot's own parameter of Widlowski et al. 2006:
//   BRF = rho0 [mu1 mu2 (mu1 + mu2)]^(k-1) (1 - Theta^2) / (1 + 2 Theta cos g + Theta^2)^1.5
//         [1 + (1 - rhoc) / (1 + G)]
// g: phase angle between view and light, 0 in the hot spot, so Theta < 0 scatters back. rhoc = rho0 with
// three parameters. Reciprocal; an energy above 1 is possible in its parameter range.
#pragma once
#include "simulate/materials/formula_lobe.h"

namespace bpms {

struct RpvParameters {
  double rho0, k, theta, rhoc;
};
double rpv_brf(const RpvParameters& p, const ReflectionAngles& angles);

// One set: separable (rho0 = 1 and its spectrum outside); or one for each band.
using RpvLobe = ParametricLobe<RpvParameters, rpv_brf>;

}  // namespace bpms
