// What the paths of one batch add up to, as unnormalised sums: the light of each sun per unit of (irradiance
// / pi) and that of the sky per unit of (horizontal irradiance / pi), by scattering order; the orders beyond
// the last kept are added to it. `Moments` turns batches into estimates.
#pragma once
#include <cstdint>
#include <vector>

#include "simulate/simulate.h"

namespace bpms {

// The rows of sums: for each order 0 ... orders, one for each sun and one for the sky; then, for each sun,
// the light of order 1 from the ground. Order 0 is what the sensor sees or receives directly.
struct Rows {
  std::size_t suns = 0;
  int orders = 0;
  std::size_t per_order() const { return suns + 1; }
  std::size_t sun(int order, std::size_t s) const {
    return static_cast<std::size_t>(order) * per_order() + s;
  }
  std::size_t sky(int order) const { return static_cast<std::size_t>(order) * per_order() + suns; }
  std::size_t ground_single(std::size_t s) const {
    return static_cast<std::size_t>(orders + 1) * per_order() + s;
  }
  std::size_t count() const { return ground_single(suns); }
  int kept(int order) const { return order < orders ? order : orders; }
};

// Means over the paths of a batch: rows x bands.
struct BatchMeans {
  Rows rows;
  std::size_t bands = 0;
  bool of_written_bands = false;  // the bands are those that are written, else those that are traced
  std::vector<double> mean;
  void reset(const Rows& layout, std::size_t count) {
    rows = layout;
    bands = count;
    mean.assign(rows.count() * bands, 0.0);
  }
  double* row(std::size_t r) { return mean.data() + r * bands; }
  const double* row(std::size_t r) const { return mean.data() + r * bands; }
};

// Counts of a batch that do not depend on the band.
struct ViewCounts {
  std::uint64_t paths = 0, rays = 0, lost = 0;
  std::uint64_t gap = 0;
  std::vector<std::uint64_t> sunlit, shaded;  // by sun and material: sun * materials + material
  std::vector<std::uint64_t> lit_behind;      // of the sunlit: lit on the face that is not seen
  std::vector<std::uint64_t> sunlit_ground;   // by sun
  void resize(std::size_t suns, std::size_t materials);
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
