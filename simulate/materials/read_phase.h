// The keys of a soil's phase function: phase = "isotropic", "henyey_greenstein" with asymmetry, or
// "legendre" with a1 and a2.
#pragma once
#include "simulate/materials/material.h"
#include "simulate/materials/scattering_phase.h"

namespace bpms {

struct SpectralPhase {
  PhaseFunction function = PhaseFunction::isotropic;
  std::vector<double> asymmetry, a1, a2;  // per band
  ScatteringPhase at(std::size_t band) const { return {function, asymmetry[band], a1[band], a2[band]}; }
};
// Refuses a1, a2 that make the function negative.
SpectralPhase read_phase(const TomlValue& table, const MaterialContext& context);

}  // namespace bpms
