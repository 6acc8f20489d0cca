// Whether a parameter is the same in all bands: then a formula has one set of parameters, and is separable.
#pragma once
#include <algorithm>
#include <functional>
#include <initializer_list>
#include <vector>

namespace bpms {

inline bool all_flat(std::initializer_list<const std::vector<double>*> spectra) {
  return std::all_of(spectra.begin(), spectra.end(), [](const std::vector<double>* spectrum) {
    return std::adjacent_find(spectrum->begin(), spectrum->end(), std::not_equal_to<>()) == spectrum->end();
  });
}

}  // namespace bpms
