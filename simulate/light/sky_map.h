// Sky radiance by direction and band, on a regular grid over the upper hemisphere, linear in between: what a
// measured map, and every model of the sky that is not isotropic, becomes.
//
// Grid: zenith angles 0 ... 90 degrees in `zeniths` - 1 equal steps (row 0 is the zenith, the last the
// horizon), azimuths 0 ... 360 in `azimuths` equal steps (column 0 looks north, clockwise; periodic).
// Radiance W m-2 sr-1 um-1. Interpolation is linear in both angles.
//
// Sampling: a cell of the grid by its mean radiance times its part of the cosine-weighted hemisphere, then a
// direction in it by the cosine. So radiance * cos / pdf varies only as the radiance does within a cell.
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

  std::size_t zeniths() const { return zeniths_; }
  std::size_t azimuths() const { return azimuths_; }
  std::size_t bands() const { return bands_; }
  // Towards the sky (unit, z >= 0), per band.
  void radiance(const Eigen::Vector3f& towards, std::span<float> out) const;
  // On the horizontal, per band: integral of radiance * cos(zenith), in closed form for the interpolated map.
  const std::vector<double>& irradiance() const { return irradiance_; }

  // Directions in proportion to the radiance, averaged over the bands (each over its own irradiance), times
  // cos(zenith); density per steradian. Where the sky is black, by the cosine alone.
  Eigen::Vector3f sample(double u, double v) const;
  float pdf(const Eigen::Vector3f& towards) const;

 private:
  struct Place {  // on the grid, the row above and the fraction below it; the same for columns
    std::size_t row, column;
    float below, beyond;
  };
  Place place(const Eigen::Vector3f& towards) const;
  void integrate();
  void prepare_sampling();
  double sine_squared(std::size_t row) const;

  std::size_t zeniths_, azimuths_, bands_;
  std::vector<float> radiance_;
  std::vector<double> irradiance_;
  // The chance of a row of cells or one above; of a cell of the row or one before it. The last is 1.
  std::vector<double> row_cumulative_, cell_cumulative_;
};

}  // namespace bpms
