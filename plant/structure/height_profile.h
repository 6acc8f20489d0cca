// Area by layers of equal height: triangles and discs that cross a border are divided exactly.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace bpms {

class HeightProfile {
 public:
  HeightProfile() = default;
  HeightProfile(double low_m, double high_m, std::size_t layers)
      : low_(low_m), height_((high_m - low_m) / static_cast<double>(layers)), area_(layers) {}

  void add_triangle(std::array<double, 3> corner_z, double area);
  void add_disc(double z, double half_height, double area);  // half_height = radius x sine of its inclination
  void add_slab(double from, double to, double area);        // spread evenly over a height
  // Another profile, scaled, then raised: `area_factor` is beside that.
  void add(const HeightProfile& other);  // of the same layers
  void add(const HeightProfile& other, double scale, double raised, double area_factor);

  std::size_t layers() const { return area_.size(); }
  double border(std::size_t k) const { return low_ + height_ * static_cast<double>(k); }
  double area(std::size_t layer) const { return area_[layer]; }
  double below() const { return below_; }  // what lies under the lowest layer
  double above() const { return above_; }

 private:
  // `fraction(z)`: the part of it that lies below z.
  template <class Fraction>
  void add_between(double from, double to, double area, Fraction fraction);

  double low_ = 0, height_ = 1;
  std::vector<double> area_;
  double below_ = 0, above_ = 0;
};

}  // namespace bpms
