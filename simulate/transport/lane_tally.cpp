#include "simulate/transport/lane_tally.h"

namespace bpms {

void LaneTally::merge(const LaneTally& other) {
  counts.merge(other.counts);
  for (std::size_t row = 0; row < rows_.size(); ++row)
    for (std::size_t i = 0; i < lanes; ++i) rows_[row][i] += other.rows_[row][i];
}

void LaneTally::means(BatchMeans& out) const {
  out.bands = optics_->bands;
  out.orders = orders_;
  out.mean.assign(out.rows() * out.bands, 0.0);
  const double share = 1.0 / static_cast<double>(counts.paths);
  for (std::size_t row = 0; row < out.rows(); ++row)
    for (std::size_t band = 0; band < out.bands; ++band) out.row(row)[band] = rows_[row][band] * share;
}

}  // namespace bpms
