#include "simulate/materials/band_places.h"

#include <algorithm>

namespace bpms {

std::vector<BandPlace> band_places(const std::vector<double>& nm, const Bands& bands,
                                   const SourceLocation& where) {
  if (bands.wavelengths_nm.empty()) bad_input(where, "a spectrum needs [bands] wavelengths_nm");
  constexpr double shortest_meant_nm = 100;  // below: x-rays, or micrometres
  std::vector<BandPlace> out;
  for (std::size_t band = 0; band < bands.count(); ++band) {
    const double at = bands.wavelengths_nm[band];
    if (at >= shortest_meant_nm && nm.back() < shortest_meant_nm)
      bad_input(where, "wavelengths from {} to {} look like micrometres: expected nm, to hold {}", nm.front(),
                nm.back(), bands.name(band));
    if (at < nm.front() || at > nm.back())
      bad_input(where, "wavelengths from {} to {} nm, which do not hold {}", nm.front(), nm.back(),
                bands.name(band));
    const auto above = static_cast<std::size_t>(std::lower_bound(nm.begin(), nm.end(), at) - nm.begin());
    const std::size_t below = above == 0 ? 0 : above - 1;
    out.push_back({below, above, above == below ? 0 : (at - nm[below]) / (nm[above] - nm[below])});
  }
  return out;
}

}  // namespace bpms
