// Sums of a batch when all bands travel with the path (at most `lanes` of them).
#pragma once
#include <array>
#include <vector>

#include "simulate/transport/optics.h"
#include "simulate/transport/sampler.h"
#include "simulate/transport/sums.h"

namespace bpms {

// guide *= what the interaction multiplies the lanes' bands by.
inline void scatter_lanes(const Optics& optics, Lanes& guide, const Scatter& by) {
  if (by.factor != no_factor) guide.multiply(optics.factors[by.factor]);
  if (by.values != nullptr)
    for (std::size_t i = 0; i < optics.lane_bands.size(); ++i)
      guide.value[i] *= by.values[optics.lane_bands[i]];
  guide.scale(by.scale);
}

class LaneTally {
 public:
  using Sum = std::array<double, lanes>;

  // The weight of a path: per lane, everything included.
  struct Weight {
    Lanes guide;
  };
  static constexpr std::size_t largest_piece(const Optics&) { return ~std::size_t{0}; }

  LaneTally(const Optics& optics, const Rows& rows) : optics_(&optics), rows_(rows), sums_(rows.count()) {}

  Weight unit(const PathNumbers&) const {
    Weight out;
    out.guide.value.fill(1.0f);
    return out;
  }
  Weight copy(const Weight& weight) const { return weight; }
  void release(const Weight&) const {}
  void scatter(Weight& weight, const Scatter& by) const { scatter_lanes(*optics_, weight.guide, by); }
  void scale(Weight& weight, float by) const { weight.guide.scale(by); }

  void add_sun(std::size_t sun, int order, const Weight& weight, const Scatter& by, bool ground) {
    Lanes value = weight.guide;
    scatter_lanes(*optics_, value, by);
    add(rows_.sun(rows_.kept(order), sun), value);
    if (order == 1 && ground) add(rows_.ground_single(sun), value);
  }
  void add_sky(int order, const Weight& weight, const Scatter& by) {
    Lanes value = weight.guide;
    scatter_lanes(*optics_, value, by);
    add(rows_.sky(rows_.kept(order)), value);
  }

  void merge(const LaneTally& other);
  void means(BatchMeans& out) const;
  ViewCounts counts;

 private:
  void add(std::size_t row, const Lanes& value) {
    for (std::size_t i = 0; i < lanes; ++i) sums_[row][i] += static_cast<double>(value.value[i]);
  }
  const Optics* optics_;
  Rows rows_;
  std::vector<Sum> sums_;
};

}  // namespace bpms
