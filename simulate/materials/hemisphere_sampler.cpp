#include "simulate/materials/hemisphere_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bpms {
namespace {

constexpr float pi_f = std::numbers::pi_v<float>;
constexpr double simple_share = 0.1;

Eigen::Vector3f direction_at(double cosine, double azimuth) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return Eigen::Vector3d(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine).cast<float>();
}

// The cell that holds x, and x within it, from 0 to 1.
template <std::size_t n>
std::size_t cell_of(const std::array<float, n>& below, float& x) {
  const auto above = std::upper_bound(below.begin() + 1, below.end() - 1, x);
  const auto cell = static_cast<std::size_t>(above - below.begin()) - 1;
  x = std::clamp((x - below[cell]) / (below[cell + 1] - below[cell]), 0.0f, 1.0f);
  return cell;
}

std::size_t cell_at(float part, std::size_t cells) {
  return std::min(static_cast<std::size_t>(std::max(part, 0.0f) * static_cast<float>(cells)), cells - 1);
}

}  // namespace

HemisphereSampler::HemisphereSampler(std::size_t bands, double exponent, const Values& values)
    : exponent_(static_cast<float>(exponent)), rows_(views) {
  std::vector<float> value(bands);
  std::vector<double> sum(bands);
  std::vector<std::vector<double>> cells(zeniths * azimuths, std::vector<double>(bands));
  double albedo = 0;
  for (std::size_t v = 0; v < views; ++v) {
    const Eigen::Vector3f view = direction_at((static_cast<double>(v) + 0.5) / views, 0);
    std::fill(sum.begin(), sum.end(), 0.0);
    for (std::size_t i = 0; i < zeniths; ++i) {
      const double cosine = std::pow((static_cast<double>(i) + 0.5) / zeniths, 1 / exponent);
      const double per_simple = cosine / static_cast<double>(simple(static_cast<float>(cosine)));
      for (std::size_t k = 0; k < azimuths; ++k) {
        const double azimuth = std::numbers::pi * (static_cast<double>(k) + 0.5) / azimuths;
        values(view, direction_at(cosine, azimuth), value);
        for (std::size_t band = 0; band < bands; ++band) {
          const double weight = static_cast<double>(value[band]) * per_simple;
          cells[i * azimuths + k][band] = weight;
          sum[band] += weight;
        }
      }
    }
    Row& row = rows_[v];
    row.below[0] = 0;
    double total = 0;
    std::array<double, zeniths + 1> below{};
    for (std::size_t i = 0; i < zeniths; ++i) {
      std::array<double, azimuths + 1> below_azimuth{};
      for (std::size_t k = 0; k < azimuths; ++k) {
        double part = 0, lit = 0;  // of the bands that reflect at all
        for (std::size_t band = 0; band < bands; ++band) {
          if (!(sum[band] > 0)) continue;
          part += cells[i * azimuths + k][band] / sum[band];
          lit += 1;
        }
        part = lit > 0 ? (1 - simple_share) * part / lit + simple_share / (zeniths * azimuths)
                       : 1.0 / (zeniths * azimuths);
        row.relative[i][k] = static_cast<float>(part * (zeniths * azimuths));
        below_azimuth[k + 1] = below_azimuth[k] + part;
      }
      total += below_azimuth[azimuths];
      below[i + 1] = total;
      for (std::size_t k = 0; k <= azimuths; ++k)
        row.below_azimuth[i][k] = static_cast<float>(below_azimuth[k] / below_azimuth[azimuths]);
    }
    for (std::size_t i = 0; i <= zeniths; ++i) row.below[i] = static_cast<float>(below[i] / total);
    for (std::size_t band = 0; band < bands; ++band)
      albedo += sum[band] / static_cast<double>(zeniths * azimuths * views * bands);
  }
  albedo_ = static_cast<float>(albedo);
}

float HemisphereSampler::simple(float cosine) const {
  return exponent_ * std::pow(cosine, exponent_ - 1) / (2 * pi_f);
}

HemisphereSampler::Between HemisphereSampler::between(float view_cosine) {
  const float at = std::clamp(view_cosine * views - 0.5f, 0.0f, static_cast<float>(views - 1));
  const std::size_t row = std::min(static_cast<std::size_t>(at), views - 2);
  return {row, at - static_cast<float>(row)};
}

bool HemisphereSampler::sample(const Eigen::Vector3f& view, float u, float v, Eigen::Vector3f& light) const {
  const Between at = between(view.z());
  const bool next = u < at.to_next;
  u = next ? u / at.to_next : (u - at.to_next) / (1 - at.to_next);
  const Row& row = rows_[at.row + (next ? 1 : 0)];
  const std::size_t i = cell_of(row.below, u);
  const bool left = v < 0.5f;
  v = left ? 2 * v : 2 * v - 1;
  const std::size_t k = cell_of(row.below_azimuth[i], v);
  const float cosine = std::pow(std::max((static_cast<float>(i) + u) / zeniths, 1e-7f), 1 / exponent_);
  const float apart = pi_f * (static_cast<float>(k) + v) / azimuths;
  const float view_azimuth = std::atan2(view.y(), view.x());
  const float azimuth = view_azimuth + (left ? apart : -apart);
  const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
  light = {sine * std::cos(azimuth), sine * std::sin(azimuth), std::min(cosine, 1.0f)};
  return true;
}

float HemisphereSampler::pdf(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const {
  if (!(light.z() > 0)) return 0;
  const Between at = between(view.z());
  // As atan2(0, 0) = 0 in `sample`: the azimuth of a view from straight above is that of x.
  const bool above = view.x() == 0 && view.y() == 0;
  const float vx = above ? 1.0f : view.x(), vy = view.y();
  const float apart = std::atan2(std::abs(vx * light.y() - vy * light.x()), vx * light.x() + vy * light.y());
  const std::size_t i = cell_at(std::pow(light.z(), exponent_), zeniths), k = cell_at(apart / pi_f, azimuths);
  const float relative =
      (1 - at.to_next) * rows_[at.row].relative[i][k] + at.to_next * rows_[at.row + 1].relative[i][k];
  return relative * simple(light.z());
}

}  // namespace bpms
