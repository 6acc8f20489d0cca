#include "simulate/transport/optics.h"

#include <numeric>

namespace bpms {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Which band each lane stands for: all of them, or guides: the band of strongest scattering and evenly spread
// ones.
std::vector<std::size_t> lane_bands(const Optics& optics) {
  std::vector<std::size_t> out;
  if (!optics.counts_interactions()) {
    for (std::size_t band = 0; band < optics.bands; ++band) out.push_back(band);
    return out;
  }
  std::size_t strongest = 0;
  double most = -1;
  for (std::size_t band = 0; band < optics.bands; ++band) {
    double sum = 0;
    for (const auto& spectrum : optics.spectra) sum += spectrum[band];
    if (sum > most) {
      most = sum;
      strongest = band;
    }
  }
  out.push_back(strongest);
  for (std::size_t i = 0; i + 1 < lanes; ++i) out.push_back(i * (optics.bands - 1) / (lanes - 2));
  return out;
}

}  // namespace

Optics make_optics(const Simulation& simulation) {
  Optics out;
  out.bands = simulation.bands.count();
  for (const Material& material : simulation.materials) {
    for (const auto& reflectance : material.reflectance) out.spectra.push_back(reflectance);
    out.spectra.push_back(material.transmittance);
    std::array<float, 2> share{};
    for (std::size_t face = 0; face < 2; ++face) {
      const double r = mean(material.reflectance[face]);
      const double t = mean(material.transmittance);
      share[face] = r + t > 0 ? static_cast<float>(r / (r + t)) : 1.0f;
    }
    out.reflect_share.push_back(share);
    out.opaque.push_back(material.opaque ? 1 : 0);
  }
  const std::vector<std::size_t> bands = lane_bands(out);
  for (const auto& spectrum : out.spectra) {
    Lanes factor;
    for (std::size_t lane = 0; lane < bands.size(); ++lane)
      factor.value[lane] = static_cast<float>(spectrum[bands[lane]]);
    out.factors.push_back(factor);
  }
  return out;
}

}  // namespace bpms
