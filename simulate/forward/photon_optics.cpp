#include "simulate/forward/photon_optics.h"

namespace bpms {

PhotonOptics::PhotonOptics(const Simulation& simulation)
    : bands(simulation.bands.count()), width((bands + 7) / 8 * 8), optics_(make_optics(simulation)) {
  const Optics& optics = optics_;
  factors_.assign(optics.spectra.size() * width, 0.0f);
  absorbed_.assign(2 * simulation.materials.size() * width, 0.0f);
  for (std::size_t f = 0; f < optics.spectra.size(); ++f)
    for (std::size_t band = 0; band < bands; ++band)
      factors_[f * width + band] = static_cast<float>(optics.spectra[f][band]);
  for (std::size_t m = 0; m < simulation.materials.size(); ++m)
    for (std::size_t face = 0; face < 2; ++face)
      for (std::size_t band = 0; band < bands; ++band)
        absorbed_[(2 * m + face) * width + band] =
            static_cast<float>(std::max(0.0, 1.0 - simulation.materials[m].reflectance[face][band] -
                                                 simulation.materials[m].transmittance[band]));
}

}  // namespace bpms
