// Where bands lie in a table of wavelengths.
#pragma once
#include "simulate/materials/spectrum.h"

namespace bpms {

struct BandPlace {
  std::size_t below;  // the value is v[below] + t (v[above] - v[below])
  std::size_t above;
  double t;
  double of(const std::vector<double>& values) const {
    return values[below] + t * (values[above] - values[below]);
  }
};

// One a band, between increasing wavelengths. Refused at `where`: a table that does not hold a band, one
// that is plainly in micrometres, a scene without wavelengths.
std::vector<BandPlace> band_places(const std::vector<double>& nm, const Bands& bands,
                                   const SourceLocation& where);

}  // namespace bpms
