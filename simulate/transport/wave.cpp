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
// How many paths ahead memory is asked for: first the path, then what its sun ray will read.
constexpr std::size_t far_ahead = 16, ahead = 8;
constexpr std::uint64_t low_word = 0xffffffffu;

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
      to_sun_(!light_.suns.empty() ? light_.suns.front().direction.cast<float>().eval()
                                   : Eigen::Vector3f::UnitZ()) {
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
      const Ray ray = sensor.start(view, {u, v}, stage_.extent);
      Path& path = paths_.emplace_back();
      path.weight = tally.unit();
      path.position = ray.origin;
      path.direction = ray.direction;
      path.extent = -1;
      path.batch = slot;
      path.sample = static_cast<std::uint32_t>(sample);
    }
  }
}

template <class Tally>
void Wave<Tally>::run() {
  for (std::size_t i = 0; i < paths_.size(); ++i) note(i);
  sort();
  for (const std::uint64_t item : order_) next_.push_back(paths_[item & low_word]);
  for (int order = 0; !next_.empty(); ++order) {
    paths_.swap(next_);
    next_.clear();
    order_.clear();
    for (std::size_t i = 0; i < paths_.size(); ++i)
      if (meet(paths_[i], order)) note(i);
    if (order == sampling_.max_order && order > 0) break;  // only the sky was still to be gathered
    sort();
    const auto path_at = [&](std::size_t i) -> Path& { return paths_[order_[i] & low_word]; };
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (i + far_ahead < order_.size()) __builtin_prefetch(&path_at(i + far_ahead));
      if (stage_.sun_rays && i + ahead < order_.size())
        stage_.sun_rays->prefetch(path_at(i + ahead).position);
      if (interact(path_at(i), order)) next_.push_back(path_at(i));
    }
  }
  paths_.clear();
  order_.clear();
  numbers_.clear();
  tallies_.clear();
}

// Where a path is along a space-filling (Morton) curve; coarse, since it only has to bring neighbours
// together.
template <class Tally>
void Wave<Tally>::note(std::size_t i) {
  const Eigen::Vector3f cell = (paths_[i].position - low_) * cells_per_m_;
  const std::uint64_t key = spread(cell.x()) | spread(cell.y()) << 1 | spread(cell.z()) << 2;
  order_.push_back(key << 32 | i);
}

// By the key, equal ones as they stand.
template <class Tally>
void Wave<Tally>::sort() {
  constexpr std::size_t digits = 10, worth_counting = 4096;
  if (order_.size() < worth_counting) {
    std::sort(order_.begin(), order_.end());
    return;
  }
  unsorted_.resize(order_.size());
  for (std::size_t shift = 32; shift < 32 + 3 * digits; shift += digits) {
    std::array<std::uint32_t, (1u << digits) + 1> start{};
    const auto digit = [shift](std::uint64_t item) { return (item >> shift) & ((1u << digits) - 1); };
    for (const std::uint64_t item : order_) ++start[digit(item) + 1];
    for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
    order_.swap(unsorted_);
    for (const std::uint64_t item : unsorted_) order_[start[digit(item)]++] = item;
  }
}

// False when it meets nothing; else the path is at what it met.
template <class Tally>
bool Wave<Tally>::meet(Path& path, int order) {
  Escape end = Escape::bottom;
  Hit hit;
  if (order > 0 || view_rays_ == nullptr)
    end = stage_.intersector->intersect(
        {path.position, path.direction, 1e30f, path.surface, path.normal, path.extent}, hit);
  else if (view_rays_->first(path.position, hit))
    end = Escape::hit;
  Tally& tally = *tallies_[path.batch];
  ++tally.counts.rays;
  if (order == 0 && (end != Escape::hit || hit.ground)) ++tally.counts.gap;
  if (end == Escape::wrap_limit) ++tally.counts.lost;
  if (end == Escape::top && light_.sky) tally.add_sky(order, path.weight);
  if (end != Escape::hit) return false;
  path.position = hit.position;
  path.normal = hit.geometric_normal;
  path.surface = hit.id;
  path.extent = hit.extent;
  path.material = hit.material;
  path.front = hit.front;
  path.ground = hit.ground;
  return true;
}

// False when the path ends.
template <class Tally>
bool Wave<Tally>::interact(Path& path, int order) {
  const bool lit = !light_.suns.empty() && gather_sun(path, order);
  ViewCounts& counts = tallies_[path.batch]->counts;
  if (order == 0) ++(lit ? counts.sunlit : counts.shaded)[path.material];
  if (order + 1 == sampling_.max_order && !light_.sky) return false;
  return scatter(path, order);
}

template <class Tally>
bool Wave<Tally>::gather_sun(const Path& path, int order) {
  const float cosine = path.normal.dot(to_sun_);
  const bool same_side = (cosine > 0) == path.front;
  if (!same_side && stage_.optics.opaque[path.material] != 0) return false;
  Tally& tally = *tallies_[path.batch];
  ++tally.counts.rays;
  if (stage_.sun_rays ? stage_.sun_rays->occluded(path.position, path.surface)
                      : stage_.intersector->occluded(
                            {path.position, to_sun_, 1e30f, path.surface, path.normal, path.extent}))
    return false;
  const Factor factor =
      same_side ? reflectance_factor(path.material, path.front) : transmittance_factor(path.material);
  tally.add_sun(order + 1, path.weight, factor, std::abs(cosine) * inverse_pi, path.ground);
  return true;
}

template <class Tally>
bool Wave<Tally>::scatter(Path& path, int order) {
  PathNumbers& numbers = numbers_[path.batch];
  numbers.start(path.sample);
  const InteractionNumbers random = numbers.interaction(static_cast<std::uint32_t>(order));
  const float share = stage_.optics.reflect_share[path.material][path.front ? 0 : 1];
  const bool reflect = random.side < static_cast<double>(share);
  if (reflect)
    tallies_[path.batch]->scatter(path.weight, reflectance_factor(path.material, path.front), 1.0f / share);
  else
    tallies_[path.batch]->scatter(path.weight, transmittance_factor(path.material), 1.0f / (1.0f - share));
  const float strength = path.weight.guide.largest();
  if (!(strength > 0)) return false;
  if (sampling_.roulette) {
    // Least variance x cost: a chance to go on in proportion to the weight (Bolin & Meyer 1997, SIGGRAPH), by
    // a factor that was measured on the homogeneous disc canopy: 1 (as absorption would do it) and 2 are
    // worse. The sky is seen by the ray that goes on from the first hit, which is then worth its cost.
    constexpr float factor = 1.6f;
    const float survival = order == 0 && light_.sky ? 1.0f : factor * strength;
    if (random.survival >= static_cast<double>(survival)) return false;
    if (survival < 1.0f) tallies_[path.batch]->scale(path.weight, 1.0f / survival);
  }
  const Eigen::Vector3f outward = path.front == reflect ? path.normal : Eigen::Vector3f(-path.normal);
  path.direction = cosine_direction(outward, random.direction_u, random.direction_v);
  return true;
}

template class Wave<LaneTally>;
template class Wave<InteractionTally>;

}  // namespace bpms
