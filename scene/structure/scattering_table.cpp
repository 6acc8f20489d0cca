#include "scene/structure/scattering_table.h"

#include "core/units.h"

namespace bpms {

std::vector<ScatteringTable> scattering_tables(const SurfaceSums& surface,
                                               const std::vector<BandOptics>& bands,
                                               const std::vector<double>& source_zenith_deg) {
  std::vector<ScatteringTable> out;
  for (const BandOptics& band : bands) {
    std::vector<ScatteringLeaves> leaves;
    double area = 0;
    for (const auto& [name, facets] : surface.leaves_of_material) {
      const auto optics = band.of_material.find(name);
      if (optics == band.of_material.end() || facets.empty()) continue;
      leaves.push_back({&facets, optics->second});
      area += facets.area();
    }
    if (leaves.empty()) continue;
    for (const double source_deg : source_zenith_deg) {
      ScatteringTable table{band.name, source_deg, 0, 0, {}};
      const double source = radians(source_deg);
      for (const ScatteringLeaves& of : leaves) {
        const double part = of.facets->area() / area * of.facets->g(source);
        table.g += part;
        table.integral += part * (of.optics.reflectance + of.optics.transmittance);
      }
      constexpr int zenith_step = 5, azimuth_step = 90;
      for (int azimuth = 0; azimuth <= 180; azimuth += azimuth_step)
        for (int zenith = 0; zenith <= 180; zenith += zenith_step)
          // The light itself travels away from its source.
          table.rows.push_back(
              {static_cast<double>(zenith), static_cast<double>(azimuth),
               area_scattering(leaves, pi - source, radians(zenith), radians(azimuth) + pi)});
      out.push_back(std::move(table));
    }
  }
  return out;
}

}  // namespace bpms
