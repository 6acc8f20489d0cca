#include "simulate/transport/sampled_tally.h"

namespace bpms {

SampledTally::SampledTally(const Optics& optics, const Rows& rows, const Simulation& simulation)
    : optics_(&optics), bands_(&simulation.bands), rows_(rows), sums_(rows.count()) {
  const auto add_source = [&](const std::vector<double>& light) {
    const std::vector<double> written = bands_->integrate(light);
    auto& relative = relative_.emplace_back(bands_->written() * optics.bands, 0.0f);
    for (std::size_t w = 0; w < bands_->written(); ++w)
      for (std::size_t t = 0; t < optics.bands; ++t)
        if (written[w] > 0) relative[w * optics.bands + t] = static_cast<float>(light[t] / written[w]);
  };
  for (const Sun& sun : simulation.light.suns) add_source(sun.irradiance);
  add_source(simulation.light.sky ? simulation.light.sky->radiance : std::vector<double>(optics.bands, 0.0));
}

SampledTally::Weight SampledTally::unit(const PathNumbers& numbers) const {
  Weight out;
  for (std::size_t w = 0; w < bands_->written(); ++w) {
    out.guide.value[w] = 1;
    double left = numbers.wavelength(static_cast<std::uint32_t>(w));
    const auto& weights = bands_->responses[w].weights;
    out.traced[w] = static_cast<std::uint16_t>(weights.back().first);
    for (const auto& weight : weights) {
      left -= weight.second;
      if (left > 0) continue;
      out.traced[w] = static_cast<std::uint16_t>(weight.first);
      break;
    }
  }
  return out;
}

Lanes SampledTally::scattered(const Weight& weight, const Scatter& by) const {
  Lanes out = weight.guide;
  for (std::size_t w = 0; w < bands_->written(); ++w) {
    float value = by.scale;
    if (by.factor != no_factor) value *= optics_->single[by.factor][weight.traced[w]];
    if (by.values != nullptr) value *= by.values[weight.traced[w]];
    out.value[w] *= value;
  }
  return out;
}

void SampledTally::add(std::size_t row, const Lanes& value, const Weight& weight, std::size_t source) {
  for (std::size_t w = 0; w < bands_->written(); ++w)
    sums_[row][w] += static_cast<double>(value.value[w]) *
                     static_cast<double>(relative_[source][w * optics_->bands + weight.traced[w]]);
}

void SampledTally::add_sun(std::size_t sun, int order, const Weight& weight, const Scatter& by, bool ground) {
  const Lanes value = scattered(weight, by);
  add(rows_.sun(rows_.kept(order), sun), value, weight, sun);
  if (order == 1 && ground) add(rows_.ground_single(sun), value, weight, sun);
}

void SampledTally::add_sky(int order, const Weight& weight, const Scatter& by) {
  add(rows_.sky(rows_.kept(order)), scattered(weight, by), weight, rows_.suns);
}

void SampledTally::merge(const SampledTally& other) {
  counts.merge(other.counts);
  for (std::size_t row = 0; row < sums_.size(); ++row)
    for (std::size_t i = 0; i < lanes; ++i) sums_[row][i] += other.sums_[row][i];
}

void SampledTally::means(BatchMeans& out) const {
  out.reset(rows_, bands_->written());
  out.of_written_bands = true;
  const double share = 1.0 / static_cast<double>(counts.paths);
  for (std::size_t row = 0; row < sums_.size(); ++row)
    for (std::size_t w = 0; w < out.bands; ++w) out.row(row)[w] = sums_[row][w] * share;
}

}  // namespace bpms
