// What the paths of one batch add up to, as unnormalised sums: the light of the sun per unit of (irradiance /
// pi) and that of the sky per unit of radiance, by scattering order; the orders beyond the last kept are
// added to it. `Moments` turns batches into estimates.
#pragma once
#include <cstdint>
#include <vector>

#include "simulate/simulate.h"

namespace bpms {

// Means over the paths of a batch: rows x bands.
// Row 0: sky met directly (order 0). Row 1: sun, order 1, from the ground. Rows 2k, 2k + 1: sun and sky of
// order k >= 1.
struct BatchMeans {
  std::size_t bands = 0;
  int orders = 0;
  std::vector<double> mean;
  static constexpr std::size_t sky_seen = 0, ground_single = 1;
  static std::size_t sun(int order) { return 2 * static_cast<std::size_t>(order); }
  static std::size_t sky(int order) { return 2 * static_cast<std::size_t>(order) + 1; }
  std::size_t rows() const { return 2 * static_cast<std::size_t>(orders) + 2; }
  double* row(std::size_t r) { return mean.data() + r * bands; }
  const double* row(std::size_t r) const { return mean.data() + r * bands; }
};

// Counts of a batch that do not depend on the band.
struct ViewCounts {
  std::uint64_t paths = 0, rays = 0, lost = 0;
  std::uint64_t gap = 0;
  std::vector<std::uint64_t> sunlit, shaded;  // by material
  void merge(const ViewCounts& other);
};

// Mean and standard error of the mean over independent batches, value by value.
class Moments {
 public:
  explicit Moments(std::size_t size) : mean_(size, 0.0), squares_(size, 0.0) {}
  void add(std::size_t index, double value, std::size_t batch) {  // batches 0, 1, 2, ... in this order
    const double delta = value - mean_[index];
    mean_[index] += delta / static_cast<double>(batch + 1);
    squares_[index] += delta * (value - mean_[index]);
  }
  double mean(std::size_t index) const { return mean_[index]; }
  double standard_error(std::size_t index, std::size_t batches) const;

 private:
  std::vector<double> mean_, squares_;
};

}  // namespace bpms
