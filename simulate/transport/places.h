// Many points put in the order of a space-filling (Morton) curve through the scene's box, so that neighbours
// follow each other: they read the same part of the scene. Coarse, since it need not do more.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "simulate/sensors/sensor.h"

namespace bpms {

class MortonCurve {
 public:
  explicit MortonCurve(const Extent& extent);
  // Where along the curve a point is: 24 bits, 256 steps an axis.
  std::uint32_t place(const Eigen::Vector3f& point) const {
    const Eigen::Vector3f cell = (point - low_) * cells_per_m_;
    return spread(cell.x()) | spread(cell.y()) << 1 | spread(cell.z()) << 2;
  }

 private:
  // The bits of a cell's number, two apart.
  static std::uint32_t spread(float x) {
    auto bits = static_cast<std::uint32_t>(std::clamp(static_cast<int>(x), 0, 255));
    bits = (bits | bits << 8) & 0x0300f00fu;
    bits = (bits | bits << 4) & 0x030c30c3u;
    return (bits | bits << 2) & 0x09249249u;
  }
  Eigen::Vector3f low_;
  float cells_per_m_;
};

// place << 32 | index of the point. By the place, equal ones as they stand.
void sort_places(std::vector<std::uint64_t>& places, std::vector<std::uint64_t>& spare);
inline constexpr std::uint64_t index_of_place = 0xffffffffu;  // mask

}  // namespace bpms
