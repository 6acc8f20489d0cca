// What every lobe promises, checked at several views: it draws what its pdf says, weights are bounded and
// their mean is the directional albedo, and the places of sun and view may be exchanged.
#pragma once
#include "tests/materials/materials_of.h"

namespace bpms::test {

struct LobeLimits {
  double largest_weight;  // of value * cosine / pdf over the albedo, in any band, up to 75 degrees
  bool reciprocal = true;
  double largest_albedo = 1 + 1e-3;  // in any band; the quadrature is good to some 1e-4
};
// Finite lobes only. Failures name the lobe by `what`.
void check_lobe(const std::string& what, const SurfaceLobe& lobe, std::size_t bands,
                const LobeLimits& limits);

// The part of a chi-square distribution above `value` (Wilson & Hilferty 1931: good to 1e-3 where it counts).
double chi_square_above(double value, double dof);

}  // namespace bpms::test
