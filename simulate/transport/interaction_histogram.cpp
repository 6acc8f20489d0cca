#include "simulate/transport/interaction_histogram.h"

#include <map>

namespace bpms {

InteractionHistogram interaction_histogram(const std::vector<InteractionTally>& batches) {
  std::map<std::vector<std::uint16_t>, std::vector<double>>
      nodes;  // in one order, whatever the batches met first
  InteractionHistogram out;
  out.batches = batches.size();
  for (std::size_t b = 0; b < batches.size(); ++b) {
    const InteractionTally& tally = batches[b];
    out.sums_per_node = tally.sums_per_node();
    for (std::uint32_t n = 0; n < tally.nodes(); ++n) {
      bool empty = true;
      for (std::size_t k = 0; k < out.sums_per_node; ++k) empty = empty && tally.mean(n, k) == 0;
      if (empty) continue;
      std::vector<double>& sums = nodes[tally.exponents(n)];
      sums.resize(out.sums_per_node * out.batches);
      for (std::size_t k = 0; k < out.sums_per_node; ++k) sums[k * out.batches + b] = tally.mean(n, k);
    }
  }
  for (const auto& node : nodes) {
    out.factors = node.first.size();
    out.exponents.insert(out.exponents.end(), node.first.begin(), node.first.end());
    out.sums.insert(out.sums.end(), node.second.begin(), node.second.end());
  }
  return out;
}

std::vector<std::string> factor_names(const Simulation& simulation) {
  std::vector<std::string> out;
  for (const Material& material : simulation.materials)
    for (const char* what : {".reflectance", ".reflectance_back", ".transmittance"})
      out.push_back(material.name + what);
  for (const Material& material : simulation.materials) {
    int number = 0;
    for (const SurfaceLobe& lobe : material.lobes) {
      ++number;
      if (!lobe.spectrum.empty()) out.push_back(material.name + ".lobe" + std::to_string(number));
    }
  }
  return out;
}

}  // namespace bpms
