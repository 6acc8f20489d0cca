#include "simulate/transport/interactions.h"

#include <algorithm>

namespace bpms {

InteractionTally::InteractionTally(const Optics& optics, const Rows& rows)
    : optics_(&optics),
      factors_(static_cast<std::uint32_t>(optics.spectra.size())),
      rows_(rows),
      nodes_(1),
      sums_(2 * rows.suns + 1),
      children_(factors_, 0) {
  by_exponents_[std::vector<std::uint16_t>(factors_, 0)] = 0;
}

std::vector<std::uint16_t> InteractionTally::exponents(std::uint32_t node) const {
  std::vector<std::uint16_t> out(factors_, 0);
  for (std::uint32_t at = node; at != 0; at = nodes_[at].parent) ++out[nodes_[at].factor];
  return out;
}

std::uint32_t InteractionTally::make_child(std::uint32_t node, Factor factor) {
  std::vector<std::uint16_t> of_child = exponents(node);
  ++of_child[factor];
  const auto next = static_cast<std::uint32_t>(nodes_.size());
  const auto [place, is_new] = by_exponents_.try_emplace(std::move(of_child), next);
  if (is_new) {
    nodes_.push_back({node, factor, nodes_[node].order + 1});
    sums_.resize(sums_.size() + sums_per_node());
    children_.resize(children_.size() + factors_, 0);
  }
  children_[node * factors_ + factor] = place->second;
  return place->second;
}

void InteractionTally::merge(const InteractionTally& other) {
  counts.merge(other.counts);
  std::vector<std::uint32_t> here(other.nodes_.size(), 0);  // the same monomial in this tally
  for (std::size_t n = 0; n < other.nodes_.size(); ++n) {
    const Node& node = other.nodes_[n];
    if (n > 0) here[n] = child(here[node.parent], node.factor);
    for (std::size_t k = 0; k < sums_per_node(); ++k) sum(here[n], k) += other.sums_[n * sums_per_node() + k];
  }
}

void InteractionTally::means(BatchMeans& out) const {
  out.reset(rows_, optics_->bands);
  const double share = 1.0 / static_cast<double>(counts.paths);
  // A block of bands at a time, so that the values of all monomials stay in cache.
  constexpr std::size_t block = 16;
  std::vector<double> values(nodes_.size() * block);
  for (std::size_t first = 0; first < out.bands; first += block) {
    const std::size_t width = std::min(block, out.bands - first);
    std::fill_n(values.begin(), block, 1.0);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const Node& node = nodes_[n];
      double* value = values.data() + n * block;
      if (n > 0) {
        const double* parent = values.data() + node.parent * block;
        const double* spectrum = optics_->spectra[node.factor].data() + first;
        for (std::size_t b = 0; b < width; ++b) value[b] = parent[b] * spectrum[b];
      }
      const int order = rows_.kept(static_cast<int>(node.order));
      const auto add = [&](std::size_t row, std::size_t which) {
        const double sum = sums_[n * sums_per_node() + which] * share;
        if (sum == 0) return;
        double* to = out.row(row) + first;
        for (std::size_t b = 0; b < width; ++b) to[b] += sum * value[b];
      };
      for (std::size_t s = 0; s < rows_.suns; ++s) {
        add(rows_.sun(order, s), s);
        add(rows_.ground_single(s), rows_.suns + 1 + s);
      }
      add(rows_.sky(order), rows_.suns);
    }
  }
}

}  // namespace bpms
