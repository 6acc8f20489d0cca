// Sky radiance by direction and band, on a regular grid over the upper hemisphere, linear in between: what a
// measured map, and every model of the sky that is not isotropic, becomes.
//
// Grid: zenith angles 0 ... 90 degrees in `zeniths` - 1 equal steps (row 0 is the zenith, the last the
// horizon), azimuths 0 ... 360 in `azimuths` equal steps (column 0 looks north, clockwise; periodic).
// Radiance W m-2 sr-1 um-1.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace bpms {

class SkyMap {
 public:
  // radiance[(row * azimuths + column) * bands + band]; zeniths >= 2, azimuths >= 1; finite and >= 0.
  SkyMap(std::size_t zeniths, std::size_t azimuths, std::size_t bands, std::vector<float> radiance);

  std::size_t bands() const { return bands_; }
  // Towards the sky (unit, z >= 0), per band.
  void radiance(const Eigen::Vector3f& towards, std::span<float> out) const;
  // On the horizontal, per band: integral of radiance * cos(zenith), exact for the interpolated map to 1e-4.
  const std::vector<double>& irradiance() const { return irradiance_; }

  // Directions in proportion to the radiance, averaged over the bands (each over its own mean), times
  // cos(zenith); density per steradian.
  Eigen::Vector3f sample(float u, float v) const;
  float pdf(const Eigen::Vector3f& towards) const;

 private:
  std::size_t zeniths_, azimuths_, bands_;
  std::vector<float> radiance_;
  std::vector<double> irradiance_;
  std::vector<float> row_cumulative_, cell_cumulative_;  // of the sampling density, by cells
};

}  // namespace bpms
