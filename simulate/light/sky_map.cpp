#include "simulate/light/sky_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bpms {
namespace {
constexpr double quarter = 0.5 * std::numbers::pi, turn = 2 * std::numbers::pi;
}  // namespace

SkyMap::SkyMap(std::size_t zeniths, std::size_t azimuths, std::size_t bands, std::vector<float> radiance)
    : zeniths_(zeniths),
      azimuths_(azimuths),
      bands_(bands),
      radiance_(std::move(radiance)),
      irradiance_(bands) {
  // The midpoint rule on a fine grid: over the interpolated map its error is far below that of any table.
  constexpr std::size_t fine_zeniths = 512, fine_azimuths = 720;
  const double dz = quarter / fine_zeniths, da = turn / fine_azimuths;
  std::vector<float> there(bands_);
  for (std::size_t i = 0; i < fine_zeniths; ++i) {
    const double z = (static_cast<double>(i) + 0.5) * dz, weight = std::sin(z) * std::cos(z) * dz * da;
    for (std::size_t k = 0; k < fine_azimuths; ++k) {
      const double a = (static_cast<double>(k) + 0.5) * da;
      this->radiance(
          Eigen::Vector3d(std::sin(z) * std::sin(a), std::sin(z) * std::cos(a), std::cos(z)).cast<float>(),
          there);
      for (std::size_t b = 0; b < bands_; ++b) irradiance_[b] += weight * static_cast<double>(there[b]);
    }
  }
  row_cumulative_.assign(1, 0);
  for (std::size_t row = 0; row + 1 < zeniths_; ++row) {
    const double step = quarter / static_cast<double>(zeniths_ - 1), low = static_cast<double>(row) * step;
    const double area = 0.5 * (std::pow(std::sin(low + step), 2) - std::pow(std::sin(low), 2)) * turn /
                        static_cast<double>(azimuths_);
    float sum = 0;
    for (std::size_t column = 0; column < azimuths_; ++column) {
      for (std::size_t b = 0; b < bands_; ++b) {
        double mean = 0;
        for (const std::size_t r : {row, row + 1})
          for (const std::size_t c : {column, (column + 1) % azimuths_})
            mean += 0.25 * static_cast<double>(radiance_[(r * azimuths_ + c) * bands_ + b]);
        if (irradiance_[b] > 0)
          sum += static_cast<float>(area * mean / irradiance_[b] / static_cast<double>(bands_));
      }
      cell_cumulative_.push_back(sum);
    }
    row_cumulative_.push_back(row_cumulative_.back() + sum);
  }
}

void SkyMap::radiance(const Eigen::Vector3f& towards, std::span<float> out) const {
  const double zenith = std::acos(std::clamp(static_cast<double>(towards.z()), 0.0, 1.0));
  double azimuth = std::atan2(towards.x(), towards.y());
  if (azimuth < 0) azimuth += turn;
  const double row = zenith / quarter * static_cast<double>(zeniths_ - 1);
  const double column = azimuth / turn * static_cast<double>(azimuths_);
  const std::size_t r = std::min(zeniths_ - 2, static_cast<std::size_t>(row));
  const std::size_t c = static_cast<std::size_t>(column) % azimuths_;
  const auto s = static_cast<float>(row - static_cast<double>(r)),
             t = static_cast<float>(column - std::floor(column));
  const float* a = &radiance_[(r * azimuths_ + c) * bands_];
  const float* b = &radiance_[(r * azimuths_ + (c + 1) % azimuths_) * bands_];
  const std::size_t below = azimuths_ * bands_;
  for (std::size_t k = 0; k < bands_; ++k)
    out[k] = (1 - s) * ((1 - t) * a[k] + t * b[k]) + s * ((1 - t) * a[k + below] + t * b[k + below]);
}

// A cell in proportion to what it gives, then evenly over its part of the horizontal.
Eigen::Vector3f SkyMap::sample(float u, float v) const {
  const float at = u * row_cumulative_.back();
  const auto above = std::upper_bound(row_cumulative_.begin() + 1, row_cumulative_.end() - 1, at);
  const auto row = static_cast<std::size_t>(above - row_cumulative_.begin()) - 1;
  const float in_row = row_cumulative_[row + 1] - row_cumulative_[row];
  const float* cells = &cell_cumulative_[row * azimuths_];
  const float left = v * cells[azimuths_ - 1];
  const auto column = static_cast<std::size_t>(std::upper_bound(cells, cells + azimuths_ - 1, left) - cells);
  const float before = column > 0 ? cells[column - 1] : 0.0f;
  const double s = std::clamp(static_cast<double>((at - row_cumulative_[row]) / in_row), 0.0, 1.0);
  const double t = std::clamp(static_cast<double>((left - before) / (cells[column] - before)), 0.0, 1.0);
  const double step = quarter / static_cast<double>(zeniths_ - 1), low = static_cast<double>(row) * step;
  const double from = std::pow(std::sin(low), 2), to = std::pow(std::sin(low + step), 2);
  const double sine2 = from + s * (to - from), sine = std::sqrt(sine2);
  const double azimuth = (static_cast<double>(column) + t) * turn / static_cast<double>(azimuths_);
  return Eigen::Vector3d(sine * std::sin(azimuth), sine * std::cos(azimuth),
                         std::sqrt(std::max(0.0, 1 - sine2)))
      .cast<float>();
}

float SkyMap::pdf(const Eigen::Vector3f& towards) const {
  if (towards.z() <= 0) return 0;
  const double zenith = std::acos(std::clamp(static_cast<double>(towards.z()), 0.0, 1.0));
  double azimuth = std::atan2(towards.x(), towards.y());
  if (azimuth < 0) azimuth += turn;
  const double step = quarter / static_cast<double>(zeniths_ - 1);
  const std::size_t row = std::min(zeniths_ - 2, static_cast<std::size_t>(zenith / step));
  const std::size_t column =
      std::min(azimuths_ - 1, static_cast<std::size_t>(azimuth / turn * static_cast<double>(azimuths_)));
  const float* cells = &cell_cumulative_[row * azimuths_];
  const double chance = static_cast<double>(cells[column] - (column > 0 ? cells[column - 1] : 0.0f)) /
                        static_cast<double>(row_cumulative_.back());
  const double low = static_cast<double>(row) * step;
  const double area = 0.5 * (std::pow(std::sin(low + step), 2) - std::pow(std::sin(low), 2)) * turn /
                      static_cast<double>(azimuths_);
  return static_cast<float>(chance / area) * towards.z();
}

}  // namespace bpms
