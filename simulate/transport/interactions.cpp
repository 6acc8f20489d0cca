#include "simulate/transport/interactions.h"

#include <algorithm>

namespace bpms {

InteractionTally::InteractionTally(const Optics& optics, int orders)
    : optics_(&optics),
      factors_(static_cast<std::uint32_t>(optics.spectra.size())),
      orders_(orders),
      nodes_(1),
      children_(factors_, 0) {
  by_exponents_[std::vector<std::uint16_t>(factors_, 0)] = 0;
}

std::uint32_t InteractionTally::make_child(std::uint32_t node, Factor factor) {
  std::vector<std::uint16_t> exponents(factors_, 0);
  ++exponents[factor];
  for (std::uint32_t at = node; at != 0; at = nodes_[at].parent) ++exponents[nodes_[at].factor];
  const auto next = static_cast<std::uint32_t>(nodes_.size());
  const auto [place, is_new] = by_exponents_.try_emplace(std::move(exponents), next);
  if (is_new) {
    Node made;
    made.parent = node;
    made.factor = factor;
    made.order = nodes_[node].order + 1;
    nodes_.push_back(made);
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
    Node& to = nodes_[here[n]];
    to.sun += node.sun, to.sky += node.sky, to.ground_single += node.ground_single;
  }
}

void InteractionTally::means(BatchMeans& out) const {
  out.bands = optics_->bands;
  out.orders = orders_;
  out.mean.assign(out.rows() * out.bands, 0.0);
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
      const int order = std::min(static_cast<int>(node.order), orders_);
      const auto add = [&](std::size_t row, double sum) {
        if (sum == 0) return;
        double* to = out.row(row) + first;
        for (std::size_t b = 0; b < width; ++b) to[b] += sum * share * value[b];
      };
      add(order == 0 ? BatchMeans::sky_seen : BatchMeans::sky(order), node.sky);
      if (order > 0) add(BatchMeans::sun(order), node.sun);
      add(BatchMeans::ground_single, node.ground_single);
    }
  }
}

}  // namespace bpms
