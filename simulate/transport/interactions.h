// Sums of a batch when there are many bands: with Lambertian materials the weight of a path is a monomial in
// the materials' reflectances and transmittances times a number that no band changes. Paths add that number
// to the monomial's node; the spectra come in once, at the end of the batch. A path then costs the same for
// one band and for thousands.
#pragma once
#include <cstdint>
#include <map>
#include <vector>

#include "simulate/transport/optics.h"
#include "simulate/transport/sums.h"

namespace bpms {

class InteractionTally {
 public:
  struct Weight {
    Lanes guide;
    float scalar = 1;
    std::uint32_t node = 0;
  };

  InteractionTally(const Optics& optics, int orders);

  Weight unit() const {
    Weight out;
    out.guide.value.fill(1.0f);
    return out;
  }
  void scatter(Weight& weight, Factor factor, float scale) {
    weight.guide.multiply(optics_->factors[factor]);
    weight.guide.scale(scale);
    weight.scalar *= scale;
    weight.node = child(weight.node, factor);
  }
  void scale(Weight& weight, float by) const {
    weight.guide.scale(by);
    weight.scalar *= by;
  }
  void add_sun(int order, const Weight& weight, Factor factor, float geometry, bool ground) {
    Node& node = nodes_[child(weight.node, factor)];
    const double value = static_cast<double>(weight.scalar) * static_cast<double>(geometry);
    node.sun += value;
    if (order == 1 && ground) node.ground_single += value;
  }
  void add_sky(int, const Weight& weight) { nodes_[weight.node].sky += static_cast<double>(weight.scalar); }

  void merge(const InteractionTally& other);
  void means(BatchMeans& out) const;
  ViewCounts counts;

 private:
  // A monomial: that of its parent times one factor. Node 0 is the number 1.
  struct Node {
    std::uint32_t parent = 0;
    Factor factor = 0;
    std::uint32_t order = 0;
    double sun = 0, sky = 0, ground_single = 0;
  };
  std::uint32_t child(std::uint32_t node, Factor factor) {
    const std::uint32_t known = children_[node * factors_ + factor];
    return known != 0 ? known : make_child(node, factor);
  }
  std::uint32_t make_child(std::uint32_t node, Factor factor);

  const Optics* optics_;
  std::uint32_t factors_;
  int orders_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> children_;  // nodes x factors; 0: not made yet
  std::map<std::vector<std::uint16_t>, std::uint32_t>
      by_exponents_;  // so that order of factors does not matter
};

}  // namespace bpms
