// What follows from a result without tracing more; errors are propagated to first order. mu0, mu: cosines of
// the zenith angles of sun s and view v; P: gap probabilities; L: the area that intercepts light over ground
// area. That is the one-sided area of leaves and half the surface of all else (stems, solids), since gaps
// count all that stands in the way: both have the mean projection 1/2 over all directions, a leaf by its one
// side, a convex body by half of its surface (Cauchy; Lang 1991, Chen & Black 1992).
//
// overlap(s, v) = P(s, v) - P(s) P(v), of a periodic scene. The errors of P(s, v), P(v) and P(s) are taken as
// independent: the first two come from the same paths, but where the ground is seen more of it is seen
// sunlit, so that their covariance could only make the error smaller.
//
// Effective projection: G(v) = -mu ln P(v) / L, that of random elements with the same gaps (clumping is in
// it).
//
// Effective area scattering phase function: co_sgl is read as the single scattering of a turbid medium
// without a hot spot, BRF1 = Gamma / (mu0 mu) (1 - exp(-(K + k) L)) / (K + k), with K = G(s) / mu0 and k =
// G(v) / mu (Ross 1981). As (K + k) L = T = -ln P(s) P(v), Gamma = BRF1 mu0 mu / L T / (1 - P(s) P(v)). BRF1
// and P(v) come from the same paths: their errors are added by size, an upper bound.
//
// Recombined reflectance: (1 - f) R_direct + f R_diffuse for any diffuse fraction f of the irradiance; the
// covariance of the two, from the batches, is in its standard error.
#pragma once
#include <optional>

#include "simulate/simulate.h"

namespace bpms {

// Of the whole scene but its ground: one side of leaves (discs, and organs of kind "leaf"), half the surface
// of shapes and of all other organs.
double intercepting_area_m2(const Scene& scene);

// Views x suns (views where there is none); a view without a number has NaN. Empty where the quantity is not
// defined: overlap without sun_gap or in an open domain, the effective ones where nothing stands too.
Estimates overlap_function(const Simulation& simulation, const Result& result, std::size_t sensor);
Estimates effective_g(const Simulation& simulation, const Result& result, std::size_t sensor);  // views
Estimates effective_g_of_suns(const Simulation& simulation, const Result& result);              // suns
Estimates effective_gamma(const Simulation& simulation, const Result& result,
                          std::size_t sensor);  // v x s x b

// Views x bands; empty unless there are suns and a sky.
Estimates recombined_reflectance(const Simulation& simulation, const SensorResult& result,
                                 const std::vector<double>& diffuse_fraction);

// The mean over the traced views by scattering order, of one band. The last order kept holds all higher
// ones, so that the last ratio is that between the two before it.
struct OrderDecay {
  std::vector<double> value, standard_error;        // reflectance of order 1, 2, ...
  std::vector<double> ratio, ratio_standard_error;  // of order n + 1 to order n
  // The smallest max_order beyond which the orders add less than the standard error of the total in every
  // view: sums of the orders kept, continued beyond them by the last ratio; none where it is not known.
  std::optional<int> enough_order;
};
std::vector<OrderDecay> order_decay(const Simulation& simulation, const SensorResult& result);  // by band

}  // namespace bpms
