#include "simulate/light/sky_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/units.h"

namespace bpms {
namespace {

// Integrals of sin cos and of angle sin cos from 0.
double first_moment(double angle) {
  return 0.25 * (1 - std::cos(2 * angle));
}
double second_moment(double angle) {
  return 0.125 * std::sin(2 * angle) - 0.25 * angle * std::cos(2 * angle);
}

// The parts of one step of a cumulative distribution; the index of the step that holds u, and how far into
// it.
struct Step {
  std::size_t index;
  double fraction;
};
Step step_of(const double* cumulative, std::size_t count, double u) {
  const double* at = std::upper_bound(cumulative, cumulative + count - 1, u);
  const double before = at == cumulative ? 0 : at[-1];
  const double width = *at - before;
  return {static_cast<std::size_t>(at - cumulative),
          width > 0 ? std::clamp((u - before) / width, 0.0, 1.0) : 0.5};
}

}  // namespace

SkyMap::SkyMap(std::size_t zeniths, std::size_t azimuths, std::size_t bands, std::vector<float> radiance)
    : zeniths_(zeniths), azimuths_(azimuths), bands_(bands), radiance_(std::move(radiance)) {
  if (zeniths_ < 2 || azimuths_ < 1 || bands_ < 1 || radiance_.size() != zeniths_ * azimuths_ * bands_)
    fail(ErrorKind::internal, {}, "a sky map of {} x {} x {} with {} values", zeniths_, azimuths_, bands_,
         radiance_.size());
  integrate();
  prepare_sampling();
}

double SkyMap::sine_squared(std::size_t row) const {
  const double sine = std::sin(0.5 * pi * static_cast<double>(row) / static_cast<double>(zeniths_ - 1));
  return sine * sine;
}

// A row weighs by the integral of its hat function (1 at its zenith, 0 at the neighbours) times sin cos.
void SkyMap::integrate() {
  irradiance_.assign(bands_, 0.0);
  const double step = 0.5 * pi / static_cast<double>(zeniths_ - 1);
  const double column_width = 2 * pi / static_cast<double>(azimuths_);
  for (std::size_t row = 0; row < zeniths_; ++row) {
    const double middle = step * static_cast<double>(row);
    double weight = 0;
    const auto slope = [&](double from, double to, double end) {  // |angle - end| / step between from and to
      const double sign = end < middle ? 1.0 : -1.0;
      return sign *
             (second_moment(to) - second_moment(from) - end * (first_moment(to) - first_moment(from))) / step;
    };
    if (row > 0) weight += slope(middle - step, middle, middle - step);
    if (row + 1 < zeniths_) weight += slope(middle, middle + step, middle + step);
    for (std::size_t column = 0; column < azimuths_; ++column)
      for (std::size_t band = 0; band < bands_; ++band)
        irradiance_[band] += weight * column_width *
                             static_cast<double>(radiance_[(row * azimuths_ + column) * bands_ + band]);
  }
}

void SkyMap::prepare_sampling() {
  std::vector<double> scale(bands_);
  for (std::size_t band = 0; band < bands_; ++band)
    scale[band] = irradiance_[band] > 0 ? 1 / irradiance_[band] : 0;
  const bool black = std::all_of(scale.begin(), scale.end(), [](double s) { return s == 0; });
  const auto brightness = [&](std::size_t row, std::size_t column) {
    if (black) return 1.0;
    const float* at = &radiance_[(row * azimuths_ + column % azimuths_) * bands_];
    return std::inner_product(scale.begin(), scale.end(), at, 0.0, std::plus<>(),
                              [](double s, float l) { return s * static_cast<double>(l); });
  };
  const std::size_t rows = zeniths_ - 1;
  row_cumulative_.resize(rows);
  cell_cumulative_.resize(rows * azimuths_);
  double total = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double part = sine_squared(row + 1) - sine_squared(row);
    double sum = 0;
    double* cells = &cell_cumulative_[row * azimuths_];
    for (std::size_t column = 0; column < azimuths_; ++column) {
      sum += brightness(row, column) + brightness(row, column + 1) + brightness(row + 1, column) +
             brightness(row + 1, column + 1);
      cells[column] = sum;
    }
    for (std::size_t column = 0; column < azimuths_; ++column)
      cells[column] =
          sum > 0 ? cells[column] / sum : static_cast<double>(column + 1) / static_cast<double>(azimuths_);
    total += sum * part;
    row_cumulative_[row] = total;
  }
  for (double& value : row_cumulative_) value /= total;
}

SkyMap::Place SkyMap::place(const Eigen::Vector3f& towards) const {
  constexpr auto quarter = static_cast<float>(pi / 2), turn = static_cast<float>(2 * pi);
  const float zenith = std::atan2(std::hypot(towards.x(), towards.y()), std::max(towards.z(), 0.0f));
  const float row = std::min(zenith / quarter, 1.0f) * static_cast<float>(zeniths_ - 1);
  const float azimuth = std::atan2(towards.x(), towards.y()) / turn;
  const float column = (azimuth < 0 ? azimuth + 1 : azimuth) * static_cast<float>(azimuths_);
  Place out{};
  out.row = std::min(static_cast<std::size_t>(row), zeniths_ - 2);
  out.below = row - static_cast<float>(out.row);
  out.column = std::min(static_cast<std::size_t>(column), azimuths_ - 1);
  out.beyond = std::min(column - static_cast<float>(out.column), 1.0f);
  return out;
}

void SkyMap::radiance(const Eigen::Vector3f& towards, std::span<float> out) const {
  const Place at = place(towards);
  const std::size_t next = at.column + 1 == azimuths_ ? 0 : at.column + 1;
  const float* upper = &radiance_[at.row * azimuths_ * bands_];
  const float* lower = upper + azimuths_ * bands_;
  const std::size_t a = at.column * bands_, b = next * bands_;
  const float wa = (1 - at.below) * (1 - at.beyond), wb = (1 - at.below) * at.beyond;
  const float wc = at.below * (1 - at.beyond), wd = at.below * at.beyond;
  for (std::size_t band = 0; band < std::min(bands_, out.size()); ++band)
    out[band] = wa * upper[a + band] + wb * upper[b + band] + wc * lower[a + band] + wd * lower[b + band];
}

Eigen::Vector3f SkyMap::sample(double u, double v) const {
  const Step row = step_of(row_cumulative_.data(), row_cumulative_.size(), u);
  const Step cell = step_of(&cell_cumulative_[row.index * azimuths_], azimuths_, v);
  const double low = sine_squared(row.index), high = sine_squared(row.index + 1);
  const double sine2 = low + row.fraction * (high - low);
  const double azimuth =
      2 * pi * (static_cast<double>(cell.index) + cell.fraction) / static_cast<double>(azimuths_);
  const double sine = std::sqrt(sine2);
  return Eigen::Vector3d(sine * std::sin(azimuth), sine * std::cos(azimuth),
                         std::sqrt(std::max(0.0, 1 - sine2)))
      .cast<float>();
}

// The chance of the cell over its part of the hemisphere, pi sin^2 being the whole; times the cosine.
float SkyMap::pdf(const Eigen::Vector3f& towards) const {
  if (!(towards.z() > 0)) return 0;
  const Place at = place(towards);
  const auto chance = [](const double* cumulative, std::size_t i) {
    return cumulative[i] - (i == 0 ? 0 : cumulative[i - 1]);
  };
  const double part = (sine_squared(at.row + 1) - sine_squared(at.row)) * pi / static_cast<double>(azimuths_);
  const double cell =
      chance(row_cumulative_.data(), at.row) * chance(&cell_cumulative_[at.row * azimuths_], at.column);
  return static_cast<float>(cell / part * static_cast<double>(towards.z()));
}

}  // namespace bpms
