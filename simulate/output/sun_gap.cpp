#include "simulate/output/sun_gap.h"

#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "simulate/transport/estimate.h"

namespace bpms {

Estimates sun_gap(const Light& light, const Intersector& intersector, std::uint64_t seed) {
  constexpr auto count = static_cast<std::uint32_t>(batches), each = sun_gap_rays / count;
  constexpr std::uint64_t purpose = 0x73756e67u;  // numbers of its own
  const Extent extent = extent_of(intersector);
  const double margin = 1e-4 * (1.0 + std::abs(extent.top_m));
  std::vector<double> share(light.suns.size() * count);
  parallel_for(share.size(), [&](std::size_t task) {
    const Eigen::Vector3d& towards = light.suns[task / count].direction;
    const auto words = philox(seed, purpose + task / count, task % count);
    const std::uint64_t scramble = static_cast<std::uint64_t>(words[0]) << 32 | words[1];
    std::uint32_t gaps = 0;
    for (std::uint32_t i = 0; i < each; ++i) {
      const Eigen::Vector2d place(sobol_owen(i, 0, scramble), sobol_owen(i, 1, scramble));
      const Eigen::Vector2d at = extent.low_m + (extent.high_m - extent.low_m).cwiseProduct(place);
      const Eigen::Vector3d origin =
          Eigen::Vector3d(at.x(), at.y(), extent.top_m) + towards * (margin / towards.z());
      Ray ray;
      ray.origin = origin.cast<float>();
      ray.direction = (-towards).cast<float>();
      Hit hit;
      gaps += intersector.intersect(ray, hit) != Escape::hit || hit.ground;
    }
    share[task] = static_cast<double>(gaps) / each;
  });
  Estimates out;
  out.resize(light.suns.size());
  for (std::size_t sun = 0; sun < light.suns.size(); ++sun) {
    Moments moments(1);
    for (std::size_t batch = 0; batch < count; ++batch) moments.add(0, share[sun * count + batch], batch);
    out.value[sun] = moments.mean(0);
    const bool one_sided = out.value[sun] <= 0 || out.value[sun] >= 1;
    out.standard_error[sun] = one_sided ? 1.0 / (sun_gap_rays + 1) : moments.standard_error(0, count);
  }
  return out;
}

}  // namespace bpms
