#include "scene/structure/gap_fraction.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/interrupt.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/units.h"

namespace bpms {
namespace {

constexpr std::uint32_t batches = 32;

std::uint64_t key(std::uint64_t seed, std::uint64_t angle, std::uint64_t batch) {
  const auto words = philox(seed, 0x676170u + angle, batch);
  return static_cast<std::uint64_t>(words[0]) << 32 | words[1];
}

}  // namespace

std::vector<double> usual_gap_angles_deg() {
  std::vector<double> out;
  for (int angle = 0; angle <= 85; angle += 5) out.push_back(angle);
  out.insert(std::upper_bound(out.begin(), out.end(), 57.5), 57.5);
  return out;
}

std::vector<Gap> gap_fraction(const Intersector& intersector, const Footprint& footprint,
                              const Ground& ground, const std::vector<double>& zenith_deg,
                              const GapOptions& options) {
  const std::uint32_t each = std::bit_ceil(std::max(1u, (options.rays + batches - 1) / batches));
  std::vector<double> share(zenith_deg.size() * batches);
  parallel_for(share.size(), [&](std::size_t task) {
    throw_if_interrupted();
    const double zenith = radians(zenith_deg[task / batches]);
    const std::uint64_t stream = key(options.seed, task / batches, task % batches);
    std::uint32_t gaps = 0;
    for (std::uint32_t i = 0; i < each; ++i) {
      const Eigen::Vector2d at = footprint.point(sobol_owen(i, 0, stream), sobol_owen(i, 1, stream));
      const double azimuth = 2 * pi * sobol_owen(i, 2, stream);
      Ray ray;
      // Off terrain by more than its rounding; the plane is named and not met again.
      constexpr double hair = 1e-5;
      const double level = ground.height_at(at);
      const double lift = ground.terrain ? hair * (at.cwiseAbs().maxCoeff() + std::abs(level) + 1) : 0;
      ray.origin = Eigen::Vector3d(at.x(), at.y(), level + lift).cast<float>();
      ray.direction = Eigen::Vector3d(std::sin(zenith) * std::cos(azimuth),
                                      std::sin(zenith) * std::sin(azimuth), std::cos(zenith))
                          .cast<float>();
      ray.from = ground_surface;
      gaps += !intersector.occluded(ray);
    }
    share[task] = static_cast<double>(gaps) / each;
  });
  std::vector<Gap> out;
  for (std::size_t a = 0; a < zenith_deg.size(); ++a) {
    double sum = 0, squares = 0;
    for (std::uint32_t b = 0; b < batches; ++b) sum += share[a * batches + b];
    const double mean = sum / batches;
    for (std::uint32_t b = 0; b < batches; ++b) squares += std::pow(share[a * batches + b] - mean, 2);
    const double none_seen = 1.0 / (static_cast<double>(each) * batches + 1);
    const bool one_sided = mean <= 0 || mean >= 1;
    out.push_back(
        {zenith_deg[a], mean, one_sided ? none_seen : std::sqrt(squares / (batches - 1) / batches)});
  }
  return out;
}

}  // namespace bpms
