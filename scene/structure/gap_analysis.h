// What is read out of gap fractions, as from instruments: contact numbers K(t) = -ln P cos t, clumping, and
// effective leaf area indices. Standard errors by the delta method, gaps of different angles independent.
#pragma once
#include <optional>
#include <vector>

#include "scene/structure/gap_fraction.h"

namespace bpms {

struct WithError {
  double value = 0, standard_error = 0;
};

// -ln P cos t; none where P is 0 or 1 (no leaf or no gap was seen).
std::optional<WithError> contact_number(const GapShare& gap, double zenith);
// Omega(t) = -ln P cos t / (G L): 1 where elements are placed at random, below where they are clumped.
std::optional<WithError> clumping_index(const GapShare& gap, double zenith, double g, double area_index);

// The area index that randomly placed elements would have with these gaps (Miller 1967):
//   L_eff = 2 int_0^90 -ln P cos t sin t dt,
// K linear between the angles, held before the first and beyond the last of them that has gaps. None without
// any.
struct MillerIntegral {
  WithError lai;
  double last_zenith_deg = 0;  // of the angles that had gaps and leaves
};
enum class GapOf { plant, leaves };
std::optional<MillerIntegral> miller_lai(const std::vector<Gap>& gaps, GapOf of);

// The rings of LI-COR's LAI-2000 and LAI-2200: 7, 23, 38, 53 and 68 degrees.
std::vector<GapDirection> plant_canopy_analyser_rings();
// 2 sum K_i w_i with the weights of its manual; none when a ring saw no gap or no leaf.
std::optional<WithError> plant_canopy_analyser_lai(const std::vector<Gap>& rings, GapOf of);

// From the one angle at which all leaf angle distributions have nearly the same G: -ln P(57.5) cos(57.5) /
// 0.5.
std::optional<WithError> lai_from_57(const std::vector<Gap>& gaps, GapOf of);

const GapShare& share(const Gap& gap, GapOf of);

}  // namespace bpms
