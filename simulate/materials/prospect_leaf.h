// PROSPECT: a leaf as N plates of one absorbing medium (Jacquemoud & Baret 1990, Remote Sens. Environ.
// 34:75), of which the constituents and their specific absorption are those of a table: PROSPECT-5 (Feret et
// al. 2008, 112:3030), -D (2017, 193:204) or -PRO (2021, 252:112173).
//
// An elementary plate absorbs k = sum of content * specific absorption / N; its transmittance for isotropic
// light is (1 - k) exp(-k) + k^2 E1(k) (Allen et al. 1969). Light enters the first one within a cone of
// `cone_rad` about the normal (40 degrees in all versions since 5: what a rough surface does); the others
// follow as Stokes 1862 adds layers, for any real N.
#pragma once
#include <array>
#include <string>

namespace bpms {

inline constexpr std::size_t leaf_constituents = 8;
// Chlorophyll, carotenoids, anthocyanins (ug cm-2), brown pigments (arbitrary), water (cm), dry matter,
// proteins, carbon-based constituents (g cm-2).
using LeafContent = std::array<double, leaf_constituents>;

struct PlateOptics {
  double reflectance, transmittance;
};
// k: absorption of one plate, n: refractive index, layers: N >= 1.
double plate_transmittance(double k);
PlateOptics prospect_leaf(double layers, double n, double k, double cone_rad);

}  // namespace bpms
