#include "simulate/forward/photon_wave.h"

#include <array>
#include <cmath>
#include <numbers>

namespace bpms {
namespace {

// The low ten bits of a cell's number, two apart.
std::uint32_t spread_ten(float x) {
  auto bits = static_cast<std::uint32_t>(std::clamp(x, 0.0f, 1023.0f));
  bits = (bits | bits << 16) & 0x030000ffu;
  bits = (bits | bits << 8) & 0x0300f00fu;
  bits = (bits | bits << 4) & 0x030c30c3u;
  return (bits | bits << 2) & 0x09249249u;
}

}  // namespace

PhotonStage::PhotonStage(const Simulation& all, const Intersector& rays)
    : simulation(&all),
      intersector(&rays),
      optics(all),
      extent(extent_of(rays)),
      sources(photon_sources(all, extent)) {}

// Basis: Duff et al. 2017, JCGT 6(1).
Eigen::Vector3f cosine_about(const Eigen::Vector3f& normal, double u, double v) {
  const auto radius = static_cast<float>(std::sqrt(u));
  const auto angle = static_cast<float>(2.0 * std::numbers::pi * v);
  const float x = radius * std::cos(angle);
  const float y = radius * std::sin(angle);
  const auto z = static_cast<float>(std::sqrt(1.0 - u));
  const float sign = std::copysign(1.0f, normal.z());
  const float a = -1.0f / (sign + normal.z());
  const float b = normal.x() * normal.y() * a;
  const Eigen::Vector3f tangent(1.0f + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x());
  const Eigen::Vector3f bitangent(b, sign + normal.y() * normal.y() * a, -normal.y());
  return (x * tangent + y * bitangent + z * normal).normalized();
}

std::uint32_t place_on_curve(const Eigen::Vector3f& point, const Extent& extent) {
  const Eigen::Vector2d size = extent.high_m - extent.low_m;
  const auto scale =
      static_cast<float>(1023.0 / std::max({size.x(), size.y(), extent.top_m - extent.bottom_m, 1e-6}));
  return spread_ten((point.x() - static_cast<float>(extent.low_m.x())) * scale) |
         spread_ten((point.y() - static_cast<float>(extent.low_m.y())) * scale) << 1 |
         spread_ten((point.z() - static_cast<float>(extent.bottom_m)) * scale) << 2;
}

void sort_places(std::vector<std::uint64_t>& places, std::vector<std::uint64_t>& spare) {
  constexpr std::size_t digits = 10, worth_counting = 4096;
  if (places.size() < worth_counting) {
    std::sort(places.begin(), places.end());
    return;
  }
  spare.resize(places.size());
  for (std::size_t shift = 32; shift < 32 + 3 * digits; shift += digits) {
    std::array<std::uint32_t, (1u << digits) + 1> start{};
    const auto digit = [shift](std::uint64_t item) { return (item >> shift) & ((1u << digits) - 1); };
    for (const std::uint64_t item : places) ++start[digit(item) + 1];
    for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
    places.swap(spare);
    for (const std::uint64_t item : spare) places[start[digit(item)]++] = item;
  }
}

bool within(const Eigen::Vector3f& point, const Extent& extent) {
  const Eigen::Array2d at = point.head<2>().cast<double>().array();
  const double hair = 1e-6 * (extent.low_m.cwiseAbs().maxCoeff() + extent.high_m.cwiseAbs().maxCoeff());
  return (at >= extent.low_m.array() - hair).all() && (at <= extent.high_m.array() + hair).all();
}

Exit exit_of(const Photon& photon, Escape escape, const Extent& extent, bool periodic) {
  if (escape == Escape::wrap_limit) return Exit::wraps;
  const Exit straight = escape == Escape::top ? Exit::top : Exit::bottom;
  if (periodic) return straight;
  const double dz = static_cast<double>(photon.direction.z());
  const double height = straight == Exit::top ? extent.top_m : extent.bottom_m;
  const double length = (height - static_cast<double>(photon.position.z())) / dz;
  if (!std::isfinite(length)) return Exit::side;
  const Eigen::Vector3f at = photon.position + static_cast<float>(std::max(0.0, length)) * photon.direction;
  return within(at, extent) ? straight : Exit::side;
}

}  // namespace bpms
