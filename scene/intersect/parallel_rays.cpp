#include "scene/intersect/parallel_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "scene/intersect/traced_scene.h"

namespace bpms {
namespace {

constexpr float bottomless = -std::numeric_limits<float>::infinity();
constexpr std::size_t worth_sharing = 500;  // discs of a prototype: fewer are listed one by one
constexpr int coarse = 64;                  // squares along a side of the grid of what stands where

std::optional<Eigen::Vector2d> period_of(const Domain& domain) {
  if (!domain.periodic) return std::nullopt;
  return domain.size_m;
}

}  // namespace

std::unique_ptr<ParallelRays> ParallelRays::make(const TracedScene& traced, const Scene& scene,
                                                 const Eigen::Vector3d& towards, std::uint64_t most_bytes) {
  if (!(towards.z() > 0)) return nullptr;
  for (const Instance& instance : scene.instances)
    if (const Prototype& p = scene.prototypes[instance.prototype]; p.mesh || !p.shapes.empty())
      return nullptr;
  if (scene.ground && scene.ground->terrain) return nullptr;
  std::unique_ptr<ParallelRays> out(new ParallelRays(traced, scene, towards));
  if (!out->build(most_bytes)) return nullptr;
  return out;
}

ParallelRays::ParallelRays(const TracedScene& traced, const Scene& scene, const Eigen::Vector3d& towards)
    : traced_(&traced),
      scene_(&scene),
      towards_(towards),
      shear_(towards.head<2>() / towards.z()),
      rest_(towards / towards.z(), period_of(scene.domain)) {}

bool ParallelRays::build(std::uint64_t most_bytes) {
  const std::vector<Instance>& instances = scene_->instances;
  const auto alike = [](const Instance& i) {
    const Eigen::Quaterniond q = i.rotation.quaternion();
    return std::tuple(i.prototype, q.w(), q.x(), q.y(), q.z(), i.scale);
  };
  std::map<decltype(alike(instances.front())), std::uint32_t> uses, groups;
  for (const Instance& instance : instances) ++uses[alike(instance)];
  std::uint32_t listed = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stand_later;
  for (std::uint32_t i = 0; i < instances.size(); ++i) {
    first_id_.push_back(listed);
    const std::size_t discs = traced_->prototype(i).discs.size();
    if (uses[alike(instances[i])] < 2 || discs < worth_sharing) {
      add_discs(i, false, rest_);
      listed += static_cast<std::uint32_t>(discs);
      continue;
    }
    const auto next = static_cast<std::uint32_t>(groups_.size());
    const auto [place, is_new] = groups.try_emplace(alike(instances[i]), next);
    if (is_new) add_discs(i, true, groups_.emplace_back(towards_ / towards_.z(), std::nullopt));
    stand_later.emplace_back(i, place->second);
  }
  if (!rest_.finish(most_bytes)) return false;
  std::uint64_t bytes = rest_.memory_bytes();
  for (FlatDiscs& group : groups_) {
    if (bytes > most_bytes || !group.finish(most_bytes - bytes)) return false;
    bytes += group.memory_bytes();
  }
  for (const auto& pair : stand_later) stand(pair.first, pair.second);
  list_standing();
  return true;
}

void ParallelRays::add_discs(std::uint32_t i, bool at_origin, FlatDiscs& to) const {
  for (const Disc& disc : traced_->prototype(i).discs) {
    Eigen::Vector3d centre = traced_->place(i, disc.centre_m.cast<double>());
    if (at_origin) centre -= scene_->instances[i].position_m;
    to.add(centre, traced_->turn(i, disc.normal.cast<double>()),
           scene_->instances[i].scale * static_cast<double>(disc.radius_m));
  }
}

// With all copies, shifted by whole periods, that reach into the cell.
void ParallelRays::stand(std::uint32_t i, std::uint32_t g) {
  const FlatDiscs& group = groups_[g];
  const Eigen::Vector3d& at = scene_->instances[i].position_m;
  Standing one;
  one.z = static_cast<float>(at.z());
  one.top = one.z + group.top();
  // A hair wider: these are rounded.
  const Eigen::Vector2d hair =
      Eigen::Vector2d::Constant(1e-6 * (group.high().cwiseAbs() + group.low().cwiseAbs()).maxCoeff());
  one.low = (group.low() - hair).cast<float>(), one.high = (group.high() + hair).cast<float>();
  one.group = g, one.instance = i;
  const Eigen::Vector2d origin = at.head<2>() - at.z() * shear_;
  Eigen::Array2d least = Eigen::Array2d::Zero(), most = least;
  const Eigen::Array2d size = scene_->domain.size_m.array();
  if (scene_->domain.periodic) {
    least = ((-0.5 * size - (origin + group.high() + hair).array()) / size).ceil();
    most = ((0.5 * size - (origin + group.low() - hair).array()) / size).floor();
  }
  for (double y = least.y(); y <= most.y(); ++y) {
    for (double x = least.x(); x <= most.x(); ++x) {
      one.u = origin.x() + (x == 0 ? 0 : x * size.x()), one.v = origin.y() + (y == 0 ? 0 : y * size.y());
      standing_.push_back(one);
    }
  }
}

void ParallelRays::list_standing() {
  std::stable_sort(standing_.begin(), standing_.end(),
                   [](const Standing& a, const Standing& b) { return a.top > b.top; });
  Eigen::Vector2d high;
  if (scene_->domain.periodic) {
    low_ = -0.5 * scene_->domain.size_m, high = -low_;
  } else {
    low_.setConstant(1e300), high.setConstant(-1e300);
    for (const Standing& s : standing_) {
      low_ = low_.cwiseMin(Eigen::Vector2d(s.u, s.v) + s.low.cast<double>());
      high = high.cwiseMax(Eigen::Vector2d(s.u, s.v) + s.high.cast<double>());
    }
  }
  if (standing_.empty()) return;
  squares_per_m_ = coarse * (high - low_).cwiseInverse();
  const auto visit = [&](const Standing& s, auto each) {
    const auto number = [&](double x, int axis) {
      return std::clamp(static_cast<int>(std::floor((x - low_[axis]) * squares_per_m_[axis])), 0, coarse - 1);
    };
    const int c1 = number(s.u + static_cast<double>(s.high.x()), 0),
              r1 = number(s.v + static_cast<double>(s.high.y()), 1);
    for (int r = number(s.v + static_cast<double>(s.low.y()), 1); r <= r1; ++r)
      for (int c = number(s.u + static_cast<double>(s.low.x()), 0); c <= c1; ++c)
        each(static_cast<std::size_t>(r * coarse + c));
  };
  first_standing_.assign(coarse * coarse + 1, 0);
  for (const Standing& s : standing_) visit(s, [&](std::size_t square) { ++first_standing_[square + 1]; });
  for (std::size_t k = 1; k < first_standing_.size(); ++k) first_standing_[k] += first_standing_[k - 1];
  listed_.resize(first_standing_.back());
  std::vector<std::uint32_t> next(first_standing_.begin(), first_standing_.end() - 1);
  for (std::uint32_t k = 0; k < standing_.size(); ++k)
    visit(standing_[k], [&](std::size_t square) { listed_[next[square]++] = k; });
}

// What stands over the ray and reaches above that height, until visit(...) says true; highest first.
template <class Visit>
void ParallelRays::visit_standing(Eigen::Vector2d at, float above, Visit visit) const {
  if (standing_.empty()) return;
  if (scene_->domain.periodic) {
    const Eigen::Vector2d& size = scene_->domain.size_m;
    for (int axis = 0; axis < 2; ++axis)
      at[axis] -= size[axis] * whole_below((at[axis] + 0.5 * size[axis]) / size[axis]);
  }
  const auto column = static_cast<long>(whole_below((at.x() - low_.x()) * squares_per_m_.x())),
             row = static_cast<long>(whole_below((at.y() - low_.y()) * squares_per_m_.y()));
  if (!scene_->domain.periodic && (column < 0 || column > coarse || row < 0 || row > coarse)) return;
  const auto square = static_cast<std::size_t>(std::clamp(row, 0L, coarse - 1L) * coarse +
                                               std::clamp(column, 0L, coarse - 1L));
  for (std::uint32_t k = first_standing_[square]; k < first_standing_[square + 1]; ++k) {
    const Standing& s = standing_[listed_[k]];
    if (s.top <= above) return;
    const double u = at.x() - s.u, v = at.y() - s.v;
    const auto x = static_cast<float>(u), y = static_cast<float>(v);
    if (x < s.low.x() || x > s.high.x() || y < s.low.y() || y > s.high.y()) continue;
    if (visit(s, u, v)) return;
  }
}

bool ParallelRays::occluded(const Look& look, float z, const SurfaceId& from) const {
  if (scene_->ground && static_cast<double>(z) < scene_->ground->height_m &&
      from.geometry != TracedScene::ground)
    return true;
  const bool on_disc = from.geometry == TracedScene::discs;
  if (look.any &&
      rest_.any_above(look.spot, z, on_disc ? first_id_[from.instance] + from.primitive : FlatDiscs::none))
    return true;
  bool met = false;
  visit_standing(look.at, z, [&](const Standing& s, double u, double v) {
    const std::uint32_t skip = on_disc && from.instance == s.instance ? from.primitive : FlatDiscs::none;
    FlatDiscs::Spot spot{};
    met = groups_[s.group].spot(u, v, spot) && groups_[s.group].any_above(spot, z - s.z, skip);
    return met;
  });
  return met;
}

bool ParallelRays::first(const Look& look, float from_z, Hit& hit) const {
  const Eigen::Vector2d& at = look.at;
  float height = scene_->ground ? static_cast<float>(scene_->ground->height_m) : bottomless;
  std::uint32_t instance = FlatDiscs::none, primitive = FlatDiscs::none;
  if (look.any) {
    const std::uint32_t id = rest_.highest(look.spot, height);
    if (id != FlatDiscs::none) {
      const auto after = std::upper_bound(first_id_.begin(), first_id_.end(), id);
      instance = static_cast<std::uint32_t>(after - first_id_.begin() - 1);
      primitive = id - first_id_[instance];
    }
  }
  visit_standing(at, height, [&](const Standing& s, double u, double v) {
    if (s.top <= height) return true;
    float own = height - s.z;
    FlatDiscs::Spot spot{};
    if (!groups_[s.group].spot(u, v, spot)) return false;
    const std::uint32_t id = groups_[s.group].highest(spot, own);
    if (id != FlatDiscs::none) height = own + s.z, instance = s.instance, primitive = id;
    return false;
  });
  if (height == bottomless) return false;
  const auto z = static_cast<double>(height);
  Eigen::Vector3d position;
  position << at + z * shear_, z;
  if (scene_->domain.periodic)
    for (int axis = 0; axis < 2; ++axis) {
      const double size = scene_->domain.size_m[axis];
      position[axis] -= size * std::floor((position[axis] + 0.5 * size) / size);
    }
  hit.position = position.cast<float>();
  hit.distance = static_cast<float>((static_cast<double>(from_z) - z) / towards_.z());
  describe(instance, primitive, hit);
  return true;
}

// Of the ground where there is no instance.
void ParallelRays::describe(std::uint32_t instance, std::uint32_t primitive, Hit& hit) const {
  hit.front = true;
  hit.ground = instance == FlatDiscs::none;
  hit.organ = 0xffffffffu;
  hit.uv.setZero();
  hit.dp_du.setZero();
  hit.dp_dv.setZero();
  if (hit.ground) {
    hit.material = scene_->ground->material;
    hit.geometric_normal = hit.shading_normal = Eigen::Vector3f::UnitZ();
    hit.id = {0, TracedScene::ground, 0};
    hit.extent = 0;
    return;
  }
  hit.id = {instance, TracedScene::discs, primitive};
  const Prototype& prototype = traced_->prototype(instance);
  const Eigen::Vector3d normal = traced_->turn(instance, prototype.discs[primitive].normal.cast<double>());
  hit.geometric_normal = hit.shading_normal = normal.cast<float>();
  hit.extent = static_cast<float>(traced_->extent(hit.id));
  hit.front = normal.dot(towards_) > 0;
  hit.material =
      prototype.material_of_disc.empty() ? prototype.disc_material : prototype.material_of_disc[primitive];
}

std::uint64_t ParallelRays::memory_bytes() const {
  std::uint64_t out = rest_.memory_bytes() + standing_.size() * sizeof(Standing) +
                      4 * (listed_.size() + first_standing_.size());
  for (const FlatDiscs& group : groups_) out += group.memory_bytes();
  return out;
}

}  // namespace bpms
