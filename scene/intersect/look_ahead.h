// Looks into a grid of parallel rays for one ray after the other, and starts to bring what the coming ones
// will read from memory while the present one is answered.
#pragma once
#include <array>
#include <cstddef>

#include "scene/intersect/parallel_rays.h"

namespace bpms {

class LookAhead {
 public:
  // `rays` must outlive it; `count` rays.
  LookAhead(const ParallelRays& rays, std::size_t count) : rays_(&rays), count_(count) {}
  // The look of ray i, which must not be less than at the last call; point(k) is a point of ray k.
  template <class Point>
  const ParallelRays::Look& at(std::size_t i, Point point) {
    for (; known_ < count_ && known_ <= i + far; ++known_) {
      ring_[known_ % ring] = rays_->look(point(known_));
      rays_->bring(ring_[known_ % ring], 0);
    }
    if (i + middle < count_) rays_->bring(ring_[(i + middle) % ring], 1);
    if (i + near < count_) rays_->bring(ring_[(i + near) % ring], 2);
    return ring_[i % ring];
  }

 private:
  static constexpr std::size_t near = 4, middle = 8, far = 12, ring = 16;
  const ParallelRays* rays_;
  std::size_t count_, known_ = 0;
  std::array<ParallelRays::Look, ring> ring_{};
};

}  // namespace bpms
