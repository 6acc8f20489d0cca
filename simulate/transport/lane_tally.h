// Sums of a batch when all bands travel with the path (at most `lanes` of them).
#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "simulate/transport/optics.h"
#include "simulate/transport/sums.h"

namespace bpms {

class LaneTally {
 public:
  using Sum = std::array<double, lanes>;

  // The weight of a path: per lane, everything included.
  struct Weight {
    Lanes guide;
  };

  LaneTally(const Optics& optics, int orders)
      : optics_(&optics), rows_(2 * static_cast<std::size_t>(orders) + 2), orders_(orders) {}

  Weight unit() const {
    Weight out;
    out.guide.value.fill(1.0f);
    return out;
  }
  void scatter(Weight& weight, Factor factor, float scale) const {
    weight.guide.multiply(optics_->factors[factor]);
    weight.guide.scale(scale);
  }
  void scale(Weight& weight, float by) const { weight.guide.scale(by); }

  void add_sun(int order, const Weight& weight, Factor factor, float geometry, bool ground) {
    Lanes value = weight.guide;
    value.multiply(optics_->factors[factor]);
    value.scale(geometry);
    add(BatchMeans::sun(std::min(order, orders_)), value);
    if (order == 1 && ground) add(BatchMeans::ground_single, value);
  }
  void add_sky(int order, const Weight& weight) {
    add(order == 0 ? BatchMeans::sky_seen : BatchMeans::sky(std::min(order, orders_)), weight.guide);
  }

  void merge(const LaneTally& other);
  void means(BatchMeans& out) const;
  ViewCounts counts;

 private:
  void add(std::size_t row, const Lanes& value) {
    for (std::size_t i = 0; i < lanes; ++i) rows_[row][i] += static_cast<double>(value.value[i]);
  }
  const Optics* optics_;
  std::vector<Sum> rows_;
  int orders_;
};

}  // namespace bpms
