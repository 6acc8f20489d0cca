// Sums of a batch when there are many bands and some of them scatter in another way than others (lobes that
// are not separable, a sky whose colour depends on the direction): each path carries a weight for every band.
#pragma once
#include <cstdint>
#include <vector>

#include "simulate/transport/lane_tally.h"

namespace bpms {

class SpectrumTally {
 public:
  // The guide steers roulette; the weights by band stand in a row of the tally's own.
  struct Weight {
    Lanes guide;
    std::uint32_t row = 0;
  };
  // Paths a batch whose rows take some 2 MiB.
  static std::size_t largest_piece(const Optics& optics) {
    return std::max<std::size_t>(16, (1u << 19) / optics.bands);
  }

  SpectrumTally(const Optics& optics, const Rows& rows)
      : optics_(&optics), rows_(rows), bands_(optics.bands), sums_(rows.count() * optics.bands) {}

  Weight unit(const PathNumbers&);
  Weight copy(const Weight& weight);
  void release(const Weight& weight) { free_.push_back(weight.row); }
  void scatter(Weight& weight, const Scatter& by);
  void scale(Weight& weight, float by) {
    weight.guide.scale(by);
    float* to = row(weight.row);
    for (std::size_t b = 0; b < bands_; ++b) to[b] *= by;
  }
  void add_sun(std::size_t sun, int order, const Weight& weight, const Scatter& by, bool ground) {
    add(rows_.sun(rows_.kept(order), sun), weight, by);
    if (order == 1 && ground) add(rows_.ground_single(sun), weight, by);
  }
  void add_sky(int order, const Weight& weight, const Scatter& by) {
    add(rows_.sky(rows_.kept(order)), weight, by);
  }

  void merge(const SpectrumTally& other);
  void means(BatchMeans& out) const;
  ViewCounts counts;

 private:
  float* row(std::uint32_t number) { return pool_.data() + number * bands_; }
  std::uint32_t take();
  void add(std::size_t sum, const Weight& weight, const Scatter& by);

  const Optics* optics_;
  Rows rows_;
  std::size_t bands_;
  std::vector<double> sums_;
  std::vector<float> pool_;
  std::vector<std::uint32_t> free_;
};

}  // namespace bpms
