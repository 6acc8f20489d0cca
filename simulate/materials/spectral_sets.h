// Sets of parameters of a formula, one a band. Where they are the same in all bands there is one set, and the
// lobe is separable.
#pragma once
#include <algorithm>
#include <functional>
#include <initializer_list>
#include <vector>

#include "simulate/materials/material.h"

namespace bpms {

inline bool all_flat(std::initializer_list<const std::vector<double>*> spectra) {
  return std::all_of(spectra.begin(), spectra.end(), [](const std::vector<double>* spectrum) {
    return std::adjacent_find(spectrum->begin(), spectrum->end(), std::not_equal_to<>()) == spectrum->end();
  });
}

// The lobe of these sets, on the faces that the table says; `one`: they are the same in all bands.
template <class FormulaLobeType, class Parameters>
SurfaceLobe lobe_of_sets(const TomlValue& table, std::vector<Parameters> sets, bool one, double exponent) {
  SurfaceLobe out;
  out.on_face = read_faces(table);
  if (one) {
    out.spectrum.assign(sets.size(), 1.0);
    sets.resize(1);
  }
  out.lobe = std::make_shared<FormulaLobeType>(std::move(sets), one, exponent);
  return out;
}

}  // namespace bpms
