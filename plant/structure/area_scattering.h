// The leaf area scattering phase function Gamma(Omega' -> Omega) of diffusely scattering leaves (Ross 1981;
// Myneni, Ross & Asrar 1989):
//   Gamma / pi = sum A |n . Omega'| |n . Omega| r / pi / sum A
// with r = the reflectance where the two directions lie on opposite sides of the facet, its transmittance
// where they lie on one side. Both directions are those in which light travels: it comes along Omega' and
// leaves along Omega. The integral of Gamma / pi over all directions Omega is (rho + tau) G(Omega').
#pragma once
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "plant/structure/orientation.h"

namespace bpms {

struct LeafOptics {
  double reflectance = 0, transmittance = 0;
};

// Optics of leaves in one band, by material.
struct BandOptics {
  std::string name;  // "B8A", "850 nm", or empty
  std::map<std::string, LeafOptics> of_material;
};

// Leaves of one material and how they scatter. A canopy may have several; areas add.
struct ScatteringLeaves {
  const FacetOrientation* facets = nullptr;
  LeafOptics optics;
};

// Gamma itself, per unit of all leaf area, for facets as they stand. Unit vectors.
double area_scattering(const std::vector<ScatteringLeaves>& leaves, const Eigen::Vector3d& incident,
                       const Eigen::Vector3d& outgoing);
// Averaged over the azimuth of the canopy: zenith angles of the two directions of travel, 0..pi (light from
// above comes with a zenith above pi/2), and the difference of their azimuths.
double area_scattering(const std::vector<ScatteringLeaves>& leaves, double incident_zenith,
                       double outgoing_zenith, double relative_azimuth);

// Closed forms. Leaves turned in all directions alike, at the angle beta between the two directions (Ross
// 1981): (rho + tau) / (3 pi) (sin beta - beta cos beta) + tau / 3 cos beta. Horizontal leaves: |cos cos'|
// times rho or tau.
double spherical_area_scattering(const LeafOptics& optics, double beta);
double horizontal_area_scattering(const LeafOptics& optics, double incident_zenith, double outgoing_zenith);

}  // namespace bpms
