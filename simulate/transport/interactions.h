// Sums of a batch when there are many bands: where every way of scattering is a spectrum times a number that
// no band changes, the weight of a path is a monomial in these spectra times such a number. Paths add that
// number to the monomial's node; the spectra come in once, at the end of the batch. A path then costs the
// same for one band and for thousands. The nodes are also what other spectra can be put into afterwards
// (interaction_histogram.h).
#pragma once
#include <cstdint>
#include <map>
#include <vector>

#include "simulate/transport/lane_tally.h"

namespace bpms {

class InteractionTally {
 public:
  struct Weight {
    Lanes guide;
    float scalar = 1;
    std::uint32_t node = 0;
  };
  static constexpr std::size_t largest_piece(const Optics&) { return ~std::size_t{0}; }

  InteractionTally(const Optics& optics, const Rows& rows);

  Weight unit(const PathNumbers&) const {
    Weight out;
    out.guide.value.fill(1.0f);
    return out;
  }
  Weight copy(const Weight& weight) const { return weight; }
  void release(const Weight&) const {}
  void scatter(Weight& weight, const Scatter& by) {
    scatter_lanes(*optics_, weight.guide, by);
    weight.scalar *= by.scale;
    if (by.factor != no_factor) weight.node = child(weight.node, by.factor);
  }
  void scale(Weight& weight, float by) const {
    weight.guide.scale(by);
    weight.scalar *= by;
  }
  void add_sun(std::size_t sun, int order, const Weight& weight, const Scatter& by, bool ground) {
    const std::uint32_t node = by.factor != no_factor ? child(weight.node, by.factor) : weight.node;
    const double value = static_cast<double>(weight.scalar) * static_cast<double>(by.scale);
    sum(node, sun) += value;
    if (order == 1 && ground) sum(node, rows_.suns + 1 + sun) += value;
  }
  void add_sky(int, const Weight& weight, const Scatter& by) {
    const std::uint32_t node = by.factor != no_factor ? child(weight.node, by.factor) : weight.node;
    sum(node, rows_.suns) += static_cast<double>(weight.scalar) * static_cast<double>(by.scale);
  }

  void merge(const InteractionTally& other);
  void means(BatchMeans& out) const;
  ViewCounts counts;

  // For the histogram: the nodes, their factors' exponents, and sums per path: of each sun, of the sky, of
  // each sun by way of the ground alone.
  std::size_t nodes() const { return nodes_.size(); }
  std::vector<std::uint16_t> exponents(std::uint32_t node) const;
  std::size_t sums_per_node() const { return 2 * rows_.suns + 1; }
  double mean(std::uint32_t node, std::size_t which) const {
    return sums_[node * sums_per_node() + which] / static_cast<double>(counts.paths);
  }

 private:
  // A monomial: that of its parent times one factor. Node 0 is the number 1. Its order is its number of
  // factors.
  struct Node {
    std::uint32_t parent = 0;
    Factor factor = 0;
    std::uint32_t order = 0;
  };
  double& sum(std::uint32_t node, std::size_t which) { return sums_[node * sums_per_node() + which]; }
  std::uint32_t child(std::uint32_t node, Factor factor) {
    const std::uint32_t known = children_[node * factors_ + factor];
    return known != 0 ? known : make_child(node, factor);
  }
  std::uint32_t make_child(std::uint32_t node, Factor factor);

  const Optics* optics_;
  std::uint32_t factors_;
  Rows rows_;
  std::vector<Node> nodes_;
  std::vector<double> sums_;             // nodes x sums_per_node
  std::vector<std::uint32_t> children_;  // nodes x factors; 0: not made yet
  std::map<std::vector<std::uint16_t>, std::uint32_t>
      by_exponents_;  // so that order of factors does not matter
};

}  // namespace bpms
