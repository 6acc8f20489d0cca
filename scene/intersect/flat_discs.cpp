#include "scene/intersect/flat_discs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace bpms {
namespace {

// A disc seen this close to edge-on covers less than that part of its area: nothing.
constexpr double thinnest = 1e-4;
constexpr long tile = 8;  // squares across a tile
constexpr float nowhere = -std::numeric_limits<float>::infinity();

}  // namespace

FlatDiscs::FlatDiscs(const Eigen::Vector3d& slope, const std::optional<Eigen::Vector2d>& period)
    : slope_(slope), period_(period), wrap_u_(std::numeric_limits<float>::infinity()), wrap_v_(wrap_u_) {
  if (!period) return;
  per_period_ = period->cwiseInverse();
  wrap_u_ = static_cast<float>(period->x());
  wrap_v_ = static_cast<float>(period->y());
}

void FlatDiscs::add(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double radius) {
  Ellipse& e = ellipses_.emplace_back();
  Bounds& box = bounds_.emplace_back();
  const double along = normal.dot(slope_);
  if (std::abs(along) < thinnest * slope_.norm()) return;
  box.u = centre.x() - centre.z() * slope_.x();
  box.v = centre.y() - centre.z() * slope_.y();
  const double a = -normal.x() / along, b = -normal.y() / along;
  const Eigen::Vector3d per_u(1 + a * slope_.x(), a * slope_.y(), a);
  const Eigen::Vector3d per_v(b * slope_.x(), 1 + b * slope_.y(), b);
  const double r2 = radius * radius;
  const double q11 = per_u.squaredNorm() / r2, q12 = per_u.dot(per_v) / r2, q22 = per_v.squaredNorm() / r2;
  const double determinant = q11 * q22 - q12 * q12;
  box.half_u = std::sqrt(q22 / determinant);
  box.half_v = std::sqrt(q11 / determinant);
  box.top = static_cast<float>(centre.z() + radius * std::sqrt(std::max(0.0, 1 - normal.z() * normal.z())));
  e.q11 = static_cast<float>(q11), e.q12 = static_cast<float>(2 * q12), e.q22 = static_cast<float>(q22);
  e.height = static_cast<float>(centre.z()), e.a = static_cast<float>(a), e.b = static_cast<float>(b);
}

bool FlatDiscs::finish(std::uint64_t most_bytes) {
  const std::uint64_t own = ellipses_.size() * sizeof(Ellipse);
  if (own > most_bytes) return false;
  if (period_)
    for (const Bounds& box : bounds_)
      if (2 * std::max(box.half_u, box.half_v) > 0.5 * period_->minCoeff()) return false;
  lay_grid();
  for (std::size_t id = 0; id < bounds_.size(); ++id) {
    Bounds& box = bounds_[id];
    if (period_) {  // into the cell: under a low sun a disc's shadow lies many periods away
      box.u -= period_->x() * std::floor((box.u - low_.x()) / period_->x());
      box.v -= period_->y() * std::floor((box.v - low_.y()) / period_->y());
    }
    ellipses_[id].u = static_cast<float>(box.u - low_.x());
    ellipses_[id].v = static_cast<float>(box.v - low_.y());
  }
  const bool fits = list(most_bytes - own);
  bounds_ = {};
  return fits;
}

bool FlatDiscs::list(std::uint64_t most_bytes) {
  first_entry_.assign(squares() + 1, 0);
  std::uint64_t count = 0;
  for (const Bounds& box : bounds_) {
    squares_of(box, [&](std::size_t square) {
      ++first_entry_[square + 1];
      ++count;
    });
  }
  if (count * sizeof(Entry) > most_bytes || count > 0xffffffffull) return false;
  for (std::size_t s = 1; s < first_entry_.size(); ++s) first_entry_[s] += first_entry_[s - 1];
  // From the highest disc down: so each list is in order.
  std::vector<std::uint32_t> falling(bounds_.size());
  std::iota(falling.begin(), falling.end(), 0u);
  std::sort(falling.begin(), falling.end(), [&](std::uint32_t x, std::uint32_t y) {
    return bounds_[x].top != bounds_[y].top ? bounds_[x].top > bounds_[y].top : x < y;
  });
  entries_.resize(count);
  std::vector<std::uint32_t> next(first_entry_.begin(), first_entry_.end() - 1);
  for (const std::uint32_t id : falling)
    squares_of(bounds_[id], [&](std::size_t square) { entries_[next[square]++] = {bounds_[id].top, id}; });
  return true;
}

// Squares about as wide as a disc's radius: short lists, few entries a disc.
void FlatDiscs::lay_grid() {
  double extent = 0;
  std::size_t count = 0;
  Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);
  top_ = nowhere;
  for (const Bounds& e : bounds_) {
    if (e.half_u < 0) continue;
    extent += e.half_u + e.half_v;
    ++count;
    low = low.cwiseMin(Eigen::Vector2d(e.u - e.half_u, e.v - e.half_v));
    high = high.cwiseMax(Eigen::Vector2d(e.u + e.half_u, e.v + e.half_v));
    top_ = std::max(top_, e.top);
  }
  if (count == 0) low.setZero(), high.setOnes();
  if (period_) low = -0.5 * *period_, high = 0.5 * *period_;
  const Eigen::Vector2d size = high - low;
  constexpr double most_squares = 1 << 24;
  const double side = std::max({count > 0 ? 0.5 * extent / static_cast<double>(count) : size.maxCoeff(),
                                std::sqrt(size.prod() / most_squares), size.maxCoeff() / most_squares});
  low_ = low;
  high_ = high;
  columns_ = std::max(1L, static_cast<long>(size.x() / side));
  rows_ = std::max(1L, static_cast<long>(size.y() / side));
  tiles_across_ = (columns_ + tile - 1) / tile;
  squares_m_ = {size.x() / static_cast<double>(columns_), size.y() / static_cast<double>(rows_)};
  squares_per_m_ = squares_m_.cwiseInverse();
}

std::size_t FlatDiscs::number_of(long column, long row) const {
  const auto c = static_cast<std::size_t>(column), r = static_cast<std::size_t>(row);
  return (r / tile * static_cast<std::size_t>(tiles_across_) + c / tile) * (tile * tile) + r % tile * tile +
         c % tile;
}

std::size_t FlatDiscs::squares() const {
  return static_cast<std::size_t>(tiles_across_ * ((rows_ + tile - 1) / tile) * tile * tile);
}

template <class Visit>
void FlatDiscs::squares_of(const Bounds& e, Visit visit) const {
  if (e.half_u < 0) return;
  const auto number = [](double x, double side) { return static_cast<long>(std::floor(x / side)); };
  const double hair = 1e-6 * squares_m_.maxCoeff();
  const long c0 = number(e.u - e.half_u - hair - low_.x(), squares_m_.x()),
             c1 = number(e.u + e.half_u + hair - low_.x(), squares_m_.x());
  const long r0 = number(e.v - e.half_v - hair - low_.y(), squares_m_.y()),
             r1 = number(e.v + e.half_v + hair - low_.y(), squares_m_.y());
  const bool wraps = period_.has_value();
  const auto inside = [wraps](long i, long count) { return wraps ? ((i % count) + count) % count : i; };
  for (long r = r0; r <= r1; ++r) {
    const long row = inside(r, rows_);
    if (row < 0 || row >= rows_) continue;
    for (long c = c0; c <= c1; ++c) {
      const long column = inside(c, columns_);
      if (column >= 0 && column < columns_) visit(number_of(column, row));
    }
  }
}

bool FlatDiscs::spot(double u, double v, Spot& out) const {
  double x = u - low_.x(), y = v - low_.y();
  if (period_) {
    x -= period_->x() * whole_below(x * per_period_.x());
    y -= period_->y() * whole_below(y * per_period_.y());
  }
  auto column = static_cast<long>(whole_below(x * squares_per_m_.x())),
       row = static_cast<long>(whole_below(y * squares_per_m_.y()));
  if (period_) column = std::clamp(column, 0L, columns_ - 1), row = std::clamp(row, 0L, rows_ - 1);
  if (column < 0 || column >= columns_ || row < 0 || row >= rows_) return false;
  out.square = number_of(column, row);
  out.u = static_cast<float>(x);
  out.v = static_cast<float>(y);
  return true;
}

// `nowhere` outside the ellipse.
float FlatDiscs::height_at(const Ellipse& e, float u, float v) const {
  float du = u - e.u, dv = v - e.v;
  if (std::abs(du) > 0.5f * wrap_u_) du -= std::copysign(wrap_u_, du);
  if (std::abs(dv) > 0.5f * wrap_v_) dv -= std::copysign(wrap_v_, dv);
  const float inside = e.q11 * du * du + e.q12 * du * dv + e.q22 * dv * dv;
  return inside <= 1.0f ? e.height + e.a * du + e.b * dv : nowhere;
}

bool FlatDiscs::any_above(const Spot& at, float z, std::uint32_t skip) const {
  for (std::uint32_t k = first_entry_[at.square]; k < first_entry_[at.square + 1]; ++k) {
    const Entry& entry = entries_[k];
    if (entry.top <= z) return false;
    if (height_at(ellipses_[entry.id], at.u, at.v) > z && entry.id != skip) return true;
  }
  return false;
}

std::uint32_t FlatDiscs::highest(const Spot& at, float& height) const {
  std::uint32_t id = none;
  for (std::uint32_t k = first_entry_[at.square]; k < first_entry_[at.square + 1]; ++k) {
    const Entry& entry = entries_[k];
    if (entry.top <= height) break;
    const float found = height_at(ellipses_[entry.id], at.u, at.v);
    if (found > height) height = found, id = entry.id;
  }
  return id;
}

std::uint64_t FlatDiscs::memory_bytes() const {
  return entries_.size() * sizeof(Entry) + first_entry_.size() * 4 + ellipses_.size() * sizeof(Ellipse);
}

}  // namespace bpms
