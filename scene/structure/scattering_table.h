// Gamma of a canopy's leaves (plant/structure/area_scattering.h) for light from a few zenith angles, averaged
// over the azimuth of the canopy, into directions above and below.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "plant/structure/area_scattering.h"
#include "scene/structure/surface_sums.h"

namespace bpms {

struct ScatteringRow {
  double view_zenith_deg = 0;       // 0..180: above 90, light that goes down
  double relative_azimuth_deg = 0;  // of the view from the source: 0 is back to the source
  double gamma = 0;
};
struct ScatteringTable {
  std::string band;
  double source_zenith_deg = 0;
  double g = 0;
  double integral = 0;  // of Gamma / pi over all directions: the mean of (rho + tau) |n . Omega|
  std::vector<ScatteringRow> rows;
};
// Materials without optics in the band take no part, neither in Gamma nor in the area it is divided by.
std::vector<ScatteringTable> scattering_tables(const SurfaceSums& surface,
                                               const std::vector<BandOptics>& bands,
                                               const std::vector<double>& source_zenith_deg);

}  // namespace bpms
