// Sums of a batch when each path draws, for every written band, one wavelength from the band's response: the
// paper's way (Lewis 1999, 4.1.4). The mean over paths is the band's, at the price of the noise of
// wavelengths; the exact weighting of all wavelengths needs none of it, and both must agree.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "simulate/transport/optics.h"
#include "simulate/transport/sampler.h"
#include "simulate/transport/sums.h"

namespace bpms {

class SampledTally {
 public:
  using Sum = std::array<double, lanes>;
  struct Weight {
    Lanes guide;                                // of each written band, at its wavelength
    std::array<std::uint16_t, lanes> traced{};  // the wavelength, as a traced band
  };
  static constexpr std::size_t largest_piece(const Optics&) { return ~std::size_t{0}; }

  SampledTally(const Optics& optics, const Rows& rows, const Simulation& simulation);

  Weight unit(const PathNumbers& numbers) const;
  Weight copy(const Weight& weight) const { return weight; }
  void release(const Weight&) const {}
  void scatter(Weight& weight, const Scatter& by) const { weight.guide = scattered(weight, by); }
  void scale(Weight& weight, float by) const { weight.guide.scale(by); }
  void add_sun(std::size_t sun, int order, const Weight& weight, const Scatter& by, bool ground);
  void add_sky(int order, const Weight& weight, const Scatter& by);

  void merge(const SampledTally& other);
  void means(BatchMeans& out) const;
  ViewCounts counts;

 private:
  Lanes scattered(const Weight& weight, const Scatter& by) const;
  void add(std::size_t row, const Lanes& value, const Weight& weight, std::size_t source);

  const Optics* optics_;
  const Bands* bands_;
  Rows rows_;
  std::vector<Sum> sums_;
  // Of each source (suns, then the sky): its light in a traced band over that in the written band.
  std::vector<std::vector<float>> relative_;  // source: written * traced bands + traced
};

}  // namespace bpms
