#include "simulate/transport/wave.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "simulate/transport/interactions.h"
#include "simulate/transport/lane_tally.h"

namespace bpms {
namespace {

constexpr float inverse_pi = std::numbers::inv_pi_v<float>;
constexpr std::size_t group = 16;  // paths whose reads of memory overlap

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

// The low ten bits of a cell's number, two apart.
std::uint64_t spread(float x) {
  auto bits = static_cast<std::uint32_t>(std::clamp(x, 0.0f, 1023.0f));
  bits = (bits | bits << 16) & 0x030000ffu;
  bits = (bits | bits << 8) & 0x0300f00fu;
  bits = (bits | bits << 4) & 0x030c30c3u;
  bits = (bits | bits << 2) & 0x09249249u;
  return bits;
}

}  // namespace

template <class Tally>
Wave<Tally>::Wave(const Stage& stage, const ParallelRays* view_rays)
    : stage_(stage),
      light_(stage.simulation->light),
      sampling_(stage.simulation->sampling),
      view_rays_(view_rays),
      to_sun_(light_.sun ? light_.sun->direction.cast<float>().eval() : Eigen::Vector3f::UnitZ()) {
  const Extent& extent = stage.extent;
  const Eigen::Vector2d size = extent.high_m - extent.low_m;
  low_ = {static_cast<float>(extent.low_m.x()), static_cast<float>(extent.low_m.y()),
          static_cast<float>(extent.bottom_m)};
  const double widest = std::max({size.x(), size.y(), extent.top_m - extent.bottom_m, 1e-6});
  cells_per_m_ = static_cast<float>(1023.0 / widest);
}

template <class Tally>
void Wave<Tally>::add(const Sensor& sensor, std::size_t view, const ViewKey& key, std::uint64_t first,
                      std::uint64_t last, std::vector<Tally>& tallies) {
  const std::size_t materials = stage_.optics.opaque.size();
  for (std::size_t batch = 0; batch < tallies.size(); ++batch) {
    Tally& tally = tallies[batch];
    tally.counts.sunlit.resize(materials);
    tally.counts.shaded.resize(materials);
    tally.counts.paths += last - first;
    PathNumbers& numbers = numbers_.emplace_back(key, static_cast<std::uint32_t>(batch));
    const auto slot = static_cast<std::uint32_t>(tallies_.size());
    tallies_.push_back(&tally);
    for (std::uint64_t sample = first; sample < last; ++sample) {
      numbers.start(sample);
      const auto [u, v] = numbers.position();
      paths_.push_back(
          {sensor.start(view, u, v, stage_.extent), tally.unit(), slot, static_cast<std::uint32_t>(sample)});
    }
  }
}

template <class Tally>
void Wave<Tally>::run() {
  for (int order = 0; !paths_.empty(); ++order) {
    sort();
    next_.clear();
    for (std::size_t from = 0; from < order_.size(); from += group)
      advance(from, std::min(order_.size(), from + group), order);
    paths_.swap(next_);
  }
  numbers_.clear();
  tallies_.clear();
}

// Along a space-filling (Morton) curve; coarse, since it only has to bring neighbours together.
template <class Tally>
void Wave<Tally>::sort() {
  order_.clear();
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const Eigen::Vector3f cell = (paths_[i].ray.origin - low_) * cells_per_m_;
    const std::uint64_t key = spread(cell.x()) | spread(cell.y()) << 1 | spread(cell.z()) << 2;
    order_.push_back(key << 32 | i);
  }
  std::sort(order_.begin(), order_.end());
}

// Some paths to their next interaction and through it. In two rounds, so that what the sun rays will read
// is on its way from memory while other paths are traced.
template <class Tally>
void Wave<Tally>::advance(std::size_t from, std::size_t to, int order) {
  std::array<Hit, group> hits;
  std::array<bool, group> met;
  const auto path_at = [&](std::size_t i) -> Path& { return paths_[order_[i] & 0xffffffffu]; };
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
template <class Tally>
bool Wave<Tally>::interact(Path& path, int order, const Hit& hit) {
  const bool lit = light_.sun && gather_sun(path, order, hit);
  if (order == 0)
    ++(lit ? tallies_[path.batch]->counts.sunlit : tallies_[path.batch]->counts.shaded)[hit.material];
  if (order + 1 == sampling_.max_order) return false;
  return scatter(path, order, hit);
}

template <class Tally>
bool Wave<Tally>::meet(const Path& path, int order, Hit& hit) {
  Escape end = Escape::bottom;
  if (order > 0 || view_rays_ == nullptr)
    end = stage_.intersector->intersect(path.ray, hit);
  else if (view_rays_->first(path.ray.origin, hit))
    end = Escape::hit;
  ++tallies_[path.batch]->counts.rays;
  if (order == 0 && (end != Escape::hit || hit.ground)) ++tallies_[path.batch]->counts.gap;
  if (end == Escape::wrap_limit) ++tallies_[path.batch]->counts.lost;
  if (end == Escape::top && light_.sky) tallies_[path.batch]->add_sky(order, path.weight);
  return end == Escape::hit;
}

template <class Tally>
bool Wave<Tally>::gather_sun(const Path& path, int order, const Hit& hit) {
  const float cosine = hit.geometric_normal.dot(to_sun_);
  const bool same_side = (cosine > 0) == hit.front;
  if (!same_side && stage_.optics.opaque[hit.material] != 0) return false;
  Ray shadow;
  shadow.origin = hit.position;
  shadow.direction = to_sun_;
  shadow.from = hit.id;
  ++tallies_[path.batch]->counts.rays;
  if (stage_.sun_rays ? stage_.sun_rays->occluded(hit.position, hit.id)
                      : stage_.intersector->occluded(shadow))
    return false;
  const Factor factor =
      same_side ? reflectance_factor(hit.material, hit.front) : transmittance_factor(hit.material);
  tallies_[path.batch]->add_sun(order + 1, path.weight, factor, std::abs(cosine) * inverse_pi, hit.ground);
  return true;
}

template <class Tally>
bool Wave<Tally>::scatter(Path& path, int order, const Hit& hit) {
  PathNumbers& numbers = numbers_[path.batch];
  numbers.start(path.sample);
  const InteractionNumbers random = numbers.interaction(static_cast<std::uint32_t>(order));
  const float share = stage_.optics.reflect_share[hit.material][hit.front ? 0 : 1];
  const bool reflect = random.side < static_cast<double>(share);
  if (reflect)
    tallies_[path.batch]->scatter(path.weight, reflectance_factor(hit.material, hit.front), 1.0f / share);
  else
    tallies_[path.batch]->scatter(path.weight, transmittance_factor(hit.material), 1.0f / (1.0f - share));
  const float strength = path.weight.guide.largest();
  if (!(strength > 0)) return false;
  if (sampling_.roulette) {
    // As absorption would do it: variance x cost is least where the chance to go on follows the weight. The
    // sky is seen by the ray that goes on from the first hit, which is then worth its cost.
    const float survival = order == 0 && light_.sky ? 1.0f : strength;
    if (random.survival >= static_cast<double>(survival)) return false;
    if (survival < 1.0f) tallies_[path.batch]->scale(path.weight, 1.0f / survival);
  }
  const Eigen::Vector3f outward =
      hit.front == reflect ? hit.geometric_normal : Eigen::Vector3f(-hit.geometric_normal);
  path.ray.origin = hit.position;
  path.ray.direction = cosine_direction(outward, random.direction_u, random.direction_v);
  path.ray.from = hit.id;
  return true;
}

template class Wave<LaneTally>;
template class Wave<InteractionTally>;

}  // namespace bpms
