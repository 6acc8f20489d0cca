// New spectra for a result without tracing again. The light of a view is a sum over monomials in the
// materials' spectra; the histogram of interactions holds the coefficients, batch by batch, so that any other
// spectra give what a run of their own with the same paths would have given, with its standard errors, and
// the derivatives by them.
#pragma once
#include <string>
#include <vector>

#include "simulate/output/output.h"
#include "simulate/output/recording.h"

namespace bpms {

// The recorded simulation with the materials (and bands) that a TOML file gives: [materials.X] for each of
// the recording (those that are not there stay as they were traced), [bands] optional.
Simulation recoloured_simulation(const Recording& recording, const std::string& materials_toml);

// A material that gave nothing in a way (transmittance 0 in all traced bands) sent no paths there: spectra
// above 0 there are refused.
Result recolour(const Recording& recording, const Simulation& with, Derivatives* derivatives = nullptr);

}  // namespace bpms
