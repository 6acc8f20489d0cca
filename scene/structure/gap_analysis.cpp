#include "scene/structure/gap_analysis.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

struct Ring {
  double centre_deg, from_deg, to_deg, weight;
};
// LI-COR, LAI-2200 instruction manual: ring limits, and sin t dt by ring, normalised.
constexpr std::array<Ring, 5> analyser_rings{{{7, 0, 12.3, 0.041},
                                              {23, 16.7, 28.6, 0.131},
                                              {38, 32.4, 43.4, 0.201},
                                              {53, 47.3, 58.1, 0.290},
                                              {68, 62.3, 74.1, 0.337}}};

// The integral of sin t times the hat that is 1 at `at`, 0 at `from` and `to`, linear between; where `from`
// (or `to`) is `at` itself, that half is missing.
double hat_weight(double from, double at, double to) {
  // int (t - a) sin t = -(t - a) cos t + sin t
  double out = 0;
  if (at > from) out += (-(at - from) * std::cos(at) + std::sin(at) - std::sin(from)) / (at - from);
  if (to > at) out += ((to - at) * std::cos(at) + std::sin(at) - std::sin(to)) / (to - at);
  return out;
}

}  // namespace

const GapShare& share(const Gap& gap, GapOf of) {
  return of == GapOf::plant ? gap.plant : gap.leaves;
}

std::optional<WithError> contact_number(const GapShare& gap, double zenith) {
  if (!(gap.p > 0) || !(gap.p < 1)) return {};
  return WithError{-std::log(gap.p) * std::cos(zenith), gap.standard_error / gap.p * std::cos(zenith)};
}

std::optional<WithError> clumping_index(const GapShare& gap, double zenith, double g, double area_index) {
  const std::optional<WithError> k = contact_number(gap, zenith);
  if (!k || !(g * area_index > 0)) return {};
  return WithError{k->value / (g * area_index), k->standard_error / (g * area_index)};
}

std::optional<MillerIntegral> miller_lai(const std::vector<Gap>& gaps, GapOf of) {
  struct Node {
    double zenith;
    WithError k;
  };
  std::vector<Node> nodes;
  for (const Gap& gap : gaps) {
    const double zenith = gap.direction.zenith;
    const GapShare& p = share(gap, of);
    if (const auto k = contact_number(p, zenith))
      nodes.push_back({zenith, *k});
    else if (p.p >= 1)
      nodes.push_back({zenith, {0, p.standard_error * std::cos(zenith)}});
  }
  if (nodes.empty()) return {};
  std::sort(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.zenith < b.zenith; });
  MillerIntegral out;
  double variance = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double at = nodes[i].zenith;
    double weight =
        hat_weight(i > 0 ? nodes[i - 1].zenith : at, at, i + 1 < nodes.size() ? nodes[i + 1].zenith : at);
    if (i == 0) weight += 1 - std::cos(at);             // held before the first
    if (i + 1 == nodes.size()) weight += std::cos(at);  // and beyond the last
    out.lai.value += 2 * weight * nodes[i].k.value;
    variance += std::pow(2 * weight * nodes[i].k.standard_error, 2);
  }
  out.lai.standard_error = std::sqrt(variance);
  out.last_zenith_deg = degrees(nodes.back().zenith);
  return out;
}

std::vector<GapDirection> plant_canopy_analyser_rings() {
  std::vector<GapDirection> out;
  for (const Ring& ring : analyser_rings)
    out.push_back({radians(ring.from_deg), radians(ring.to_deg), 0, 2 * pi});
  return out;
}

std::optional<WithError> plant_canopy_analyser_lai(const std::vector<Gap>& rings, GapOf of) {
  if (rings.size() != analyser_rings.size()) return {};
  WithError out;
  double variance = 0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const auto k = contact_number(share(rings[i], of), radians(analyser_rings[i].centre_deg));
    if (!k) return {};
    out.value += 2 * analyser_rings[i].weight * k->value;
    variance += std::pow(2 * analyser_rings[i].weight * k->standard_error, 2);
  }
  out.standard_error = std::sqrt(variance);
  return out;
}

std::optional<WithError> lai_from_57(const std::vector<Gap>& gaps, GapOf of) {
  constexpr double angle_deg = 57.5, g = 0.5;
  for (const Gap& gap : gaps) {
    if (std::abs(gap.zenith_deg() - angle_deg) > 1e-6) continue;
    if (const auto k = contact_number(share(gap, of), gap.direction.zenith))
      return WithError{k->value / g, k->standard_error / g};
  }
  return {};
}

}  // namespace bpms
