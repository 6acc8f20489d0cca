// Phase functions of soil grains and leaves, by the phase angle g between view and light (0: straight back).
// Their mean over the sphere is 1.
#pragma once
#include <cmath>

#include "core/toml.h"

namespace bpms {

enum class PhaseFunction { isotropic, henyey_greenstein, legendre };

struct ScatteringPhase {
  PhaseFunction function = PhaseFunction::isotropic;
  double asymmetry = 0;   // Henyey & Greenstein 1941; < 0 scatters back
  double a1 = 0, a2 = 0;  // Legendre: 1 + a1 cos g + a2 (3 cos^2 g - 1) / 2; a1 > 0 scatters back
  double operator()(double cos_phase) const {
    if (function == PhaseFunction::henyey_greenstein) {
      const double squared = 1 + asymmetry * asymmetry + 2 * asymmetry * cos_phase;
      return (1 - asymmetry * asymmetry) / (squared * std::sqrt(squared));
    }
    if (function == PhaseFunction::legendre)
      return 1 + a1 * cos_phase + a2 * (3 * cos_phase * cos_phase - 1) / 2;
    return 1;
  }
};

}  // namespace bpms
