#include "plant/structure/height_profile.h"

#include <cmath>

#include "core/units.h"

namespace bpms {

template <class Fraction>
void HeightProfile::add_between(double from, double to, double area, Fraction fraction) {
  const double last = static_cast<double>(area_.size()) - 1;
  const double lowest = std::floor((from - low_) / height_), highest = std::floor((to - low_) / height_);
  const double first = std::clamp(lowest, 0.0, last);
  if (lowest == highest && lowest >= 0 && lowest <= last) {
    area_[static_cast<std::size_t>(first)] += area;
    return;
  }
  double before = from < low_ ? fraction(low_) : 0.0;
  below_ += area * before;
  const double end = std::clamp(highest, -1.0, last);
  for (double k = first; k <= end; ++k) {
    const auto layer = static_cast<std::size_t>(k);
    const double until = to <= border(layer + 1) ? 1.0 : fraction(border(layer + 1));
    area_[layer] += area * (until - before);
    before = until;
  }
  // What ends at the top, to rounding, belongs to the uppermost layer.
  constexpr double hair = 1e-9;
  const bool ends = to <= border(area_.size()) + hair * height_;
  (ends ? area_.back() : above_) += area * (1 - before);
}

void HeightProfile::add_triangle(std::array<double, 3> z, double area) {
  std::sort(z.begin(), z.end());
  const double low = z[0], middle = z[1], high = z[2];
  add_between(low, high, area, [&](double h) {
    if (h <= low) return 0.0;
    if (h >= high) return 1.0;
    if (h < middle) return (h - low) * (h - low) / ((middle - low) * (high - low));
    return 1 - (high - h) * (high - h) / ((high - middle) * (high - low));
  });
}

void HeightProfile::add_disc(double z, double half, double area) {
  add_between(z - half, z + half, area, [&](double h) {
    if (!(half > 0)) return h < z ? 0.0 : 1.0;
    const double u = std::clamp((h - z) / half, -1.0, 1.0);
    return 0.5 + (u * std::sqrt(1 - u * u) + std::asin(u)) / pi;
  });
}

void HeightProfile::add_slab(double from, double to, double area) {
  add_between(from, to, area, [&](double h) {
    return to > from ? std::clamp((h - from) / (to - from), 0.0, 1.0) : h < from ? 0.0 : 1.0;
  });
}

void HeightProfile::add(const HeightProfile& other) {
  for (std::size_t k = 0; k < other.layers(); ++k) area_[k] += other.area_[k];
  below_ += other.below_;
  above_ += other.above_;
}

void HeightProfile::add(const HeightProfile& other, double scale, double raised, double area_factor) {
  for (std::size_t k = 0; k < other.layers(); ++k) {
    if (other.area(k) > 0)
      add_slab(scale * other.border(k) + raised, scale * other.border(k + 1) + raised,
               area_factor * other.area(k));
  }
}

}  // namespace bpms
