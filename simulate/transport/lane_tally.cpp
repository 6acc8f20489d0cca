#include "simulate/transport/lane_tally.h"

namespace bpms {

void LaneTally::merge(const LaneTally& other) {
  counts.merge(other.counts);
  for (std::size_t row = 0; row < sums_.size(); ++row)
    for (std::size_t i = 0; i < lanes; ++i) sums_[row][i] += other.sums_[row][i];
}

void LaneTally::means(BatchMeans& out) const {
  out.reset(rows_, optics_->bands);
  const double share = 1.0 / static_cast<double>(counts.paths);
  for (std::size_t row = 0; row < sums_.size(); ++row)
    for (std::size_t band = 0; band < out.bands; ++band) out.row(row)[band] = sums_[row][band] * share;
}

}  // namespace bpms
