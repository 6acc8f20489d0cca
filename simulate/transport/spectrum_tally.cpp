#include "simulate/transport/spectrum_tally.h"

#include <algorithm>

namespace bpms {

std::uint32_t SpectrumTally::take() {
  if (free_.empty()) {
    pool_.resize(pool_.size() + bands_);
    return static_cast<std::uint32_t>(pool_.size() / bands_ - 1);
  }
  const std::uint32_t out = free_.back();
  free_.pop_back();
  return out;
}

SpectrumTally::Weight SpectrumTally::unit(const PathNumbers&) {
  Weight out;
  out.guide.value.fill(1.0f);
  out.row = take();
  std::fill_n(row(out.row), bands_, 1.0f);
  return out;
}

SpectrumTally::Weight SpectrumTally::copy(const Weight& weight) {
  Weight out = weight;
  out.row = take();
  std::copy_n(row(weight.row), bands_, row(out.row));
  return out;
}

void SpectrumTally::scatter(Weight& weight, const Scatter& by) {
  scatter_lanes(*optics_, weight.guide, by);
  float* to = row(weight.row);
  if (by.factor != no_factor) {
    const float* spectrum = optics_->single[by.factor].data();
    for (std::size_t b = 0; b < bands_; ++b) to[b] *= by.scale * spectrum[b];
  } else {
    for (std::size_t b = 0; b < bands_; ++b) to[b] *= by.scale;
  }
  if (by.values != nullptr)
    for (std::size_t b = 0; b < bands_; ++b) to[b] *= by.values[b];
}

void SpectrumTally::add(std::size_t sum, const Weight& weight, const Scatter& by) {
  double* to = sums_.data() + sum * bands_;
  const float* from = row(weight.row);
  const float* spectrum = by.factor != no_factor ? optics_->single[by.factor].data() : nullptr;
  for (std::size_t b = 0; b < bands_; ++b) {
    float value = from[b] * by.scale;
    if (spectrum != nullptr) value *= spectrum[b];
    if (by.values != nullptr) value *= by.values[b];
    to[b] += static_cast<double>(value);
  }
}

void SpectrumTally::merge(const SpectrumTally& other) {
  counts.merge(other.counts);
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
}

void SpectrumTally::means(BatchMeans& out) const {
  out.reset(rows_, bands_);
  const double share = 1.0 / static_cast<double>(counts.paths);
  for (std::size_t i = 0; i < sums_.size(); ++i) out.mean[i] = sums_[i] * share;
}

}  // namespace bpms
