// Discs seen along one direction: ellipses in the plane of (u, v) = (x - z dx/dz, y - z dy/dz), where a ray
// of that direction is a point. A grid over the plane lists the ellipses that touch each square, highest
// first, so that a ray looks through one short list. With a period the plane is a torus.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/large_vector.h"

namespace bpms {

// std::floor, which is a call where the processor is not known to have it.
inline double whole_below(double x) {
  const auto whole = static_cast<double>(static_cast<std::int64_t>(x));
  return whole > x ? whole - 1 : whole;
}

class FlatDiscs {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;

  // `slope`: the direction over its z. The period's cell is centred at the origin.
  FlatDiscs(const Eigen::Vector3d& slope, const std::optional<Eigen::Vector2d>& period);
  // Numbered as they come; unit normals.
  void add(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double radius);
  // Makes the grid. False: a disc is seen wider than half the period, or it takes more bytes.
  bool finish(std::uint64_t most_bytes);

  // Where the ray at (u, v) looks.
  struct Spot {
    std::size_t square;
    float u, v;
  };
  bool spot(double u, double v, Spot& out) const;  // false: nothing is there
  // Is any disc but `skip` met above z?
  bool any_above(const Spot& at, float z, std::uint32_t skip) const;
  // The disc met highest, when above `height`, which it raises; or none.
  std::uint32_t highest(const Spot& at, float& height) const;
  // Starts to bring what these will read from memory, one thing after the other: each is found in the one
  // before.
  void bring_square(const Spot& at) const { __builtin_prefetch(&first_entry_[at.square]); }
  void bring_list(const Spot& at) const { __builtin_prefetch(&entries_[first_entry_[at.square]]); }
  void bring_disc(const Spot& at) const {
    const std::uint32_t first = first_entry_[at.square];
    if (first < first_entry_[at.square + 1]) __builtin_prefetch(&ellipses_[entries_[first].id]);
  }

  // What is covered, without a period.
  const Eigen::Vector2d& low() const { return low_; }
  const Eigen::Vector2d& high() const { return high_; }
  float top() const { return top_; }
  bool empty() const { return ellipses_.empty(); }
  std::uint64_t memory_bytes() const;

 private:
  // Offsets from its centre: du, dv. Inside where q11 du^2 + q12 du dv + q22 dv^2 <= 1; there its height is
  // height + a du + b dv.
  struct alignas(32) Ellipse {
    float u, v, q11, q12, q22, height, a, b;
  };
  // Of a square's list, highest first.
  struct Entry {
    float top;
    std::uint32_t id;
  };
  struct Bounds {  // half_u < 0: seen edge-on, covers nothing
    double u = 0, v = 0, half_u = -1, half_v = 0;
    float top = 0;
  };
  void lay_grid();
  bool list(std::uint64_t most_bytes);
  std::size_t number_of(long column, long row) const;
  std::size_t squares() const;
  template <class Visit>
  void squares_of(const Bounds& bounds, Visit visit) const;
  float height_at(const Ellipse& ellipse, float u, float v) const;

  Eigen::Vector3d slope_;
  std::optional<Eigen::Vector2d> period_;
  float wrap_u_, wrap_v_;  // infinite where there is no period
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero(), high_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d squares_m_ = Eigen::Vector2d::Ones();  // sides, which close on a period
  Eigen::Vector2d squares_per_m_ = Eigen::Vector2d::Ones(), per_period_ = Eigen::Vector2d::Zero();
  float top_ = 0;
  long columns_ = 1, rows_ = 1;
  long tiles_across_ = 1;       // squares are numbered by tiles: neighbours are near in memory
  std::vector<Bounds> bounds_;  // while it is made
  LargeVector<Ellipse> ellipses_;
  LargeVector<std::uint32_t> first_entry_;  // of each square, and the end
  LargeVector<Entry> entries_;
};

}  // namespace bpms
