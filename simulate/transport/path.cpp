#include "simulate/transport/path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/interrupt.h"
#include "simulate/transport/interactions.h"
#include "simulate/transport/lane_tally.h"

namespace bpms {
namespace {

constexpr float inverse_pi = std::numbers::inv_pi_v<float>;

// A direction about `normal` with density cos/pi. Basis: Duff et al. 2017, JCGT 6(1).
Eigen::Vector3f cosine_direction(const Eigen::Vector3f& normal, double u, double v) {
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

// A path on its way: the ray that it goes on with.
template <class Tally>
struct Path {
  Ray ray;
  typename Tally::Weight weight;
  std::uint64_t sample;
};

// Many paths advance together, one interaction at a time, in the order of where they are: neighbours read the
// same part of the scene, which is several times as fast as to follow each path to its end.
template <class Tally>
class Wave {
 public:
  Wave(const Stage& stage, const ParallelRays* view_rays, PathNumbers numbers, Tally& tally)
      : stage_(stage),
        optics_(stage.optics),
        light_(stage.simulation->light),
        sampling_(stage.simulation->sampling),
        view_rays_(view_rays),
        numbers_(numbers),
        tally_(tally),
        to_sun_(light_.sun ? light_.sun->direction.cast<float>().eval() : Eigen::Vector3f::UnitZ()) {
    const Extent& extent = stage.extent;
    const Eigen::Vector2d size = extent.high_m - extent.low_m;
    low_ = {static_cast<float>(extent.low_m.x()), static_cast<float>(extent.low_m.y()),
            static_cast<float>(extent.bottom_m)};
    const double widest = std::max({size.x(), size.y(), extent.top_m - extent.bottom_m, 1e-6});
    cells_per_m_ = static_cast<float>(1023.0 / widest);
  }

  void trace(const Sensor& sensor, std::size_t view, std::uint64_t first, std::uint64_t last) {
    paths_.clear();
    for (std::uint64_t sample = first; sample < last; ++sample) {
      numbers_.start(sample);
      const auto [u, v] = numbers_.position();
      paths_.push_back({sensor.start(view, u, v, stage_.extent), tally_.unit(), sample});
    }
    for (int order = 0; !paths_.empty(); ++order) {
      sort();
      next_.clear();
      for (std::size_t from = 0; from < order_.size(); from += group)
        advance(from, std::min(order_.size(), from + group), order);
      paths_.swap(next_);
    }
    tally_.counts.paths += last - first;
  }

  static constexpr std::size_t group = 16;

 private:
  // Along a space-filling (Morton) curve.
  void sort() {
    order_.clear();
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      const Eigen::Vector3f cell = (paths_[i].ray.origin - low_) * cells_per_m_;
      const std::uint64_t key = spread(cell.x()) | spread(cell.y()) << 1 | spread(cell.z()) << 2;
      order_.push_back(key << 32 | i);
    }
    std::sort(order_.begin(), order_.end());
  }
  static std::uint64_t spread(float x) {
    auto bits = static_cast<std::uint32_t>(std::clamp(x, 0.0f, 1023.0f));
    bits = (bits | bits << 16) & 0x030000ffu;
    bits = (bits | bits << 8) & 0x0300f00fu;
    bits = (bits | bits << 4) & 0x030c30c3u;
    bits = (bits | bits << 2) & 0x09249249u;
    return bits;
  }

  // Some paths to their next interaction and through it. In two rounds, so that what the sun rays will read
  // is on its way from memory while other paths are traced.
  void advance(std::size_t from, std::size_t to, int order) {
    std::array<Hit, group> hits;
    std::array<bool, group> met;
    const auto path_at = [&](std::size_t i) -> Path<Tally>& { return paths_[order_[i] & 0xffffffffu]; };
    if (order == 0 && view_rays_ != nullptr)
      for (std::size_t i = from; i < to; ++i) view_rays_->prefetch(path_at(i).ray.origin);
    for (std::size_t i = from; i < to; ++i) {
      met[i - from] = meet(path_at(i), order, hits[i - from]);
      if (met[i - from] && stage_.sun_rays) stage_.sun_rays->prefetch(hits[i - from].position);
    }
    for (std::size_t i = from; i < to; ++i)
      if (met[i - from] && interact(path_at(i), order, hits[i - from])) next_.push_back(path_at(i));
  }

  // False when the path ends.
  bool interact(Path<Tally>& path, int order, const Hit& hit) {
    const bool lit = light_.sun && gather_sun(path, order, hit);
    if (order == 0) ++(lit ? tally_.counts.sunlit : tally_.counts.shaded)[hit.material];
    if (order + 1 == sampling_.max_order) return false;
    return scatter(path, order, hit);
  }

  bool meet(const Path<Tally>& path, int order, Hit& hit) {
    Escape end = Escape::bottom;
    if (order > 0 || view_rays_ == nullptr)
      end = stage_.intersector->intersect(path.ray, hit);
    else if (view_rays_->first(path.ray.origin, hit))
      end = Escape::hit;
    ++tally_.counts.rays;
    if (order == 0 && (end != Escape::hit || hit.ground)) ++tally_.counts.gap;
    if (end == Escape::wrap_limit) ++tally_.counts.lost;
    if (end == Escape::top && light_.sky) tally_.add_sky(order, path.weight);
    return end == Escape::hit;
  }

  bool gather_sun(const Path<Tally>& path, int order, const Hit& hit) {
    const float cosine = hit.geometric_normal.dot(to_sun_);
    const bool same_side = (cosine > 0) == hit.front;
    if (!same_side && optics_.opaque[hit.material] != 0) return false;
    Ray shadow;
    shadow.origin = hit.position;
    shadow.direction = to_sun_;
    shadow.from = hit.id;
    ++tally_.counts.rays;
    if (stage_.sun_rays ? stage_.sun_rays->occluded(hit.position, hit.id)
                        : stage_.intersector->occluded(shadow))
      return false;
    const Factor factor =
        same_side ? reflectance_factor(hit.material, hit.front) : transmittance_factor(hit.material);
    tally_.add_sun(order + 1, path.weight, factor, std::abs(cosine) * inverse_pi, hit.ground);
    return true;
  }

  bool scatter(Path<Tally>& path, int order, const Hit& hit) {
    numbers_.start(path.sample);
    const InteractionNumbers random = numbers_.interaction(static_cast<std::uint32_t>(order));
    const float share = optics_.reflect_share[hit.material][hit.front ? 0 : 1];
    const bool reflect = random.side < static_cast<double>(share);
    if (reflect)
      tally_.scatter(path.weight, reflectance_factor(hit.material, hit.front), 1.0f / share);
    else
      tally_.scatter(path.weight, transmittance_factor(hit.material), 1.0f / (1.0f - share));
    const float strength = path.weight.guide.largest();
    if (!(strength > 0)) return false;
    if (sampling_.roulette) {
      // As absorption would do it: variance x cost is least where the chance to go on follows the weight. The
      // sky is seen by the ray that goes on from the first hit, which is then worth its cost.
      const float survival = order == 0 && light_.sky ? 1.0f : strength;
      if (random.survival >= static_cast<double>(survival)) return false;
      if (survival < 1.0f) tally_.scale(path.weight, 1.0f / survival);
    }
    const Eigen::Vector3f outward =
        hit.front == reflect ? hit.geometric_normal : Eigen::Vector3f(-hit.geometric_normal);
    path.ray.origin = hit.position;
    path.ray.direction = cosine_direction(outward, random.direction_u, random.direction_v);
    path.ray.from = hit.id;
    return true;
  }

  const Stage& stage_;
  const Optics& optics_;
  const Light& light_;
  const Sampling& sampling_;
  const ParallelRays* view_rays_;
  PathNumbers numbers_;
  Tally& tally_;
  Eigen::Vector3f to_sun_, low_;
  float cells_per_m_;
  std::vector<Path<Tally>> paths_, next_;
  std::vector<std::uint64_t> order_;
};

}  // namespace

Stage make_stage(const Simulation& simulation, const Intersector& intersector) {
  Stage out{&intersector, &simulation, make_optics(simulation), extent_of(intersector), nullptr};
  if (simulation.light.sun)
    out.sun_rays = intersector.parallel_rays(simulation.scene, simulation.light.sun->direction);
  return out;
}

template <class Tally>
void trace_paths(const Stage& stage, const Sensor& sensor, std::size_t view, const ParallelRays* view_rays,
                 PathNumbers numbers, std::uint64_t first, std::uint64_t last, Tally& tally) {
  tally.counts.sunlit.resize(stage.optics.opaque.size());
  tally.counts.shaded.resize(stage.optics.opaque.size());
  constexpr std::uint64_t together =
      32768;  // a chunk is traced whole: a path's orders come at different times
  Wave<Tally> wave(stage, view_rays, numbers, tally);
  for (std::uint64_t from = first; from < last && !interrupted(); from += together)
    wave.trace(sensor, view, from, std::min(last, from + together));
}

template void trace_paths(const Stage&, const Sensor&, std::size_t, const ParallelRays*, PathNumbers,
                          std::uint64_t, std::uint64_t, LaneTally&);
template void trace_paths(const Stage&, const Sensor&, std::size_t, const ParallelRays*, PathNumbers,
                          std::uint64_t, std::uint64_t, InteractionTally&);

}  // namespace bpms
