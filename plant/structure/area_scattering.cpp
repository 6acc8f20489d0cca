#include "plant/structure/area_scattering.h"

#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

double facet_scattering(const LeafOptics& optics, double in, double out) {
  const double product = in * out;
  return product < 0 ? -product * optics.reflectance : product * optics.transmittance;
}

}  // namespace

double area_scattering(const std::vector<ScatteringLeaves>& leaves, const Eigen::Vector3d& incident,
                       const Eigen::Vector3d& outgoing) {
  double sum = 0, area = 0;
  for (const ScatteringLeaves& of : leaves) {
    area += of.facets->area();
    for (const FacetOrientation::Cell& cell : of.facets->cells()) {
      if (!(cell.area > 0)) continue;
      const double in = cell.vector.dot(incident), out = cell.vector.dot(outgoing);
      sum += facet_scattering(of.optics, in, out) / cell.area;
    }
  }
  return sum / area;
}

double area_scattering(const std::vector<ScatteringLeaves>& leaves, double incident_zenith,
                       double outgoing_zenith, double relative_azimuth) {
  constexpr int azimuths = 180;
  const double up_in = std::cos(incident_zenith), side_in = std::sin(incident_zenith);
  const double up_out = std::cos(outgoing_zenith), side_out = std::sin(outgoing_zenith);
  double sum = 0, area = 0;
  for (const ScatteringLeaves& of : leaves) {
    area += of.facets->area();
    for (const FacetOrientation::Band& band : of.facets->bands()) {
      if (!(band.area > 0)) continue;
      const double c = std::cos(band.inclination), s = std::sin(band.inclination);
      double mean = 0;
      for (int k = 0; k < azimuths; ++k) {
        const double azimuth = 2 * pi * (k + 0.5) / azimuths;
        mean += facet_scattering(of.optics, c * up_in + s * side_in * std::cos(azimuth),
                                 c * up_out + s * side_out * std::cos(azimuth - relative_azimuth));
      }
      sum += band.area * mean / azimuths;
    }
  }
  return sum / area;
}

double spherical_area_scattering(const LeafOptics& optics, double beta) {
  const double omega = optics.reflectance + optics.transmittance;
  return omega / (3 * pi) * (std::sin(beta) - beta * std::cos(beta)) +
         optics.transmittance / 3 * std::cos(beta);
}

double horizontal_area_scattering(const LeafOptics& optics, double incident_zenith, double outgoing_zenith) {
  return facet_scattering(optics, std::cos(incident_zenith), std::cos(outgoing_zenith));
}

}  // namespace bpms
