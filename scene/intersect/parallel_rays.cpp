#include "scene/intersect/parallel_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scene/intersect/traced_scene.h"

namespace bpms {
namespace {

// A disc seen this close to edge-on covers less than that part of its area: nothing.
constexpr double thinnest = 1e-4;
constexpr long tile = 8;  // squares across a tile
constexpr float nowhere = -std::numeric_limits<float>::infinity();

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
      wrap_u_(std::numeric_limits<float>::infinity()),
      wrap_v_(wrap_u_) {
  if (!scene.domain.periodic) return;
  wrap_u_ = static_cast<float>(scene.domain.size_m.x());
  wrap_v_ = static_cast<float>(scene.domain.size_m.y());
}

bool ParallelRays::build(std::uint64_t most_bytes) {
  std::uint64_t count = 0;
  for (const Instance& instance : scene_->instances) {
    first_id_.push_back(static_cast<std::uint32_t>(count));
    count += scene_->prototypes[instance.prototype].discs.size();
  }
  if (count * sizeof(Ellipse) > most_bytes) return false;
  ellipses_.resize(count);
  std::vector<Bounds> bounds(count);
  if (!flatten(bounds)) return false;
  lay_grid(bounds);
  // In a periodic domain within the cell: a high disc seen at a slant lies several periods off, and only the
  // nearest of its images counts.
  const bool wraps = scene_->domain.periodic;
  const auto in_cell = [wraps](double x, double size) { return wraps ? x - size * std::floor(x / size) : x; };
  for (std::size_t id = 0; id < bounds.size(); ++id) {
    ellipses_[id].u = static_cast<float>(in_cell(bounds[id].u - low_.x(), scene_->domain.size_m.x()));
    ellipses_[id].v = static_cast<float>(in_cell(bounds[id].v - low_.y(), scene_->domain.size_m.y()));
  }
  return list(bounds, most_bytes - count * sizeof(Ellipse));
}

// The discs as ellipses, but for their centres, which count from the grid's corner.
bool ParallelRays::flatten(std::vector<Bounds>& bounds) {
  const Eigen::Vector3d slope(shear_.x(), shear_.y(), 1);
  for (std::uint32_t i = 0; i < scene_->instances.size(); ++i) {
    const std::vector<Disc>& discs = traced_->prototype(i).discs;
    for (std::size_t k = 0; k < discs.size(); ++k) {
      Ellipse& e = ellipses_[first_id_[i] + k];
      Bounds& box = bounds[first_id_[i] + k];
      const Eigen::Vector3d centre = traced_->place(i, discs[k].centre_m.cast<double>());
      const Eigen::Vector3d normal = traced_->turn(i, discs[k].normal.cast<double>());
      const double radius = scene_->instances[i].scale * static_cast<double>(discs[k].radius_m);
      const double along = normal.dot(slope);
      box.half_u = -1;
      if (std::abs(along) < thinnest * slope.norm()) continue;
      box.u = centre.x() - centre.z() * shear_.x();
      box.v = centre.y() - centre.z() * shear_.y();
      const double a = -normal.x() / along, b = -normal.y() / along;
      const Eigen::Vector3d per_u(1 + a * shear_.x(), a * shear_.y(), a);
      const Eigen::Vector3d per_v(b * shear_.x(), 1 + b * shear_.y(), b);
      const double r2 = radius * radius;
      const double q11 = per_u.squaredNorm() / r2, q12 = per_u.dot(per_v) / r2,
                   q22 = per_v.squaredNorm() / r2;
      const double determinant = q11 * q22 - q12 * q12;
      box.half_u = std::sqrt(q22 / determinant);
      box.half_v = std::sqrt(q11 / determinant);
      box.top =
          static_cast<float>(centre.z() + radius * std::sqrt(std::max(0.0, 1 - normal.z() * normal.z())));
      e.q11 = static_cast<float>(q11), e.q12 = static_cast<float>(2 * q12), e.q22 = static_cast<float>(q22);
      e.height = static_cast<float>(centre.z()), e.a = static_cast<float>(a), e.b = static_cast<float>(b);
      if (scene_->domain.periodic &&
          2 * std::max(box.half_u, box.half_v) > 0.5 * scene_->domain.size_m.minCoeff())
        return false;
    }
  }
  return true;
}

bool ParallelRays::list(const std::vector<Bounds>& bounds, std::uint64_t most_bytes) {
  first_entry_.assign(squares() + 1, 0);
  std::uint64_t count = 0;
  for (const Bounds& box : bounds) {
    squares_of(box, [&](std::size_t square) {
      ++first_entry_[square + 1];
      ++count;
    });
  }
  if (count * sizeof(Entry) > most_bytes || count > 0xffffffffull) return false;
  for (std::size_t s = 1; s < first_entry_.size(); ++s) first_entry_[s] += first_entry_[s - 1];
  // From the highest disc down: so each list is in order.
  std::vector<std::uint32_t> falling(bounds.size());
  std::iota(falling.begin(), falling.end(), 0u);
  std::sort(falling.begin(), falling.end(), [&](std::uint32_t x, std::uint32_t y) {
    return bounds[x].top != bounds[y].top ? bounds[x].top > bounds[y].top : x < y;
  });
  entries_.resize(count);
  std::vector<std::uint32_t> next(first_entry_.begin(), first_entry_.end() - 1);
  for (const std::uint32_t id : falling)
    squares_of(bounds[id], [&](std::size_t square) { entries_[next[square]++] = {bounds[id].top, id}; });
  return true;
}

// Squares about as wide as a disc's radius: short lists, few entries a disc.
void ParallelRays::lay_grid(const std::vector<Bounds>& bounds) {
  double extent = 0;
  std::size_t count = 0;
  Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);
  for (const Bounds& e : bounds) {
    if (e.half_u < 0) continue;
    extent += e.half_u + e.half_v;
    ++count;
    low = low.cwiseMin(Eigen::Vector2d(e.u - e.half_u, e.v - e.half_v));
    high = high.cwiseMax(Eigen::Vector2d(e.u + e.half_u, e.v + e.half_v));
  }
  if (count == 0) low.setZero(), high.setOnes();
  const Domain& domain = scene_->domain;
  if (domain.periodic) low = -0.5 * domain.size_m, high = 0.5 * domain.size_m;
  const Eigen::Vector2d size = high - low;
  constexpr double most_squares = 1 << 24;
  const double side = std::max({count > 0 ? 0.5 * extent / static_cast<double>(count) : size.maxCoeff(),
                                std::sqrt(size.prod() / most_squares), size.maxCoeff() / most_squares});
  low_ = low;
  columns_ = std::max(1L, static_cast<long>(size.x() / side));
  rows_ = std::max(1L, static_cast<long>(size.y() / side));
  tiles_across_ = (columns_ + tile - 1) / tile;
  squares_m_ = {size.x() / static_cast<double>(columns_), size.y() / static_cast<double>(rows_)};
}

std::size_t ParallelRays::number_of(long column, long row) const {
  const long in_tile = row % tile * tile + column % tile;
  return static_cast<std::size_t>((row / tile * tiles_across_ + column / tile) * tile * tile + in_tile);
}

std::size_t ParallelRays::squares() const {
  return static_cast<std::size_t>(tiles_across_ * ((rows_ + tile - 1) / tile) * tile * tile);
}

template <class Visit>
void ParallelRays::squares_of(const Bounds& e, Visit visit) const {
  if (e.half_u < 0) return;
  const auto number = [](double x, double side) { return static_cast<long>(std::floor(x / side)); };
  const double hair = 1e-6 * squares_m_.maxCoeff();
  const long c0 = number(e.u - e.half_u - hair - low_.x(), squares_m_.x()),
             c1 = number(e.u + e.half_u + hair - low_.x(), squares_m_.x());
  const long r0 = number(e.v - e.half_v - hair - low_.y(), squares_m_.y()),
             r1 = number(e.v + e.half_v + hair - low_.y(), squares_m_.y());
  const bool wraps = scene_->domain.periodic;
  const auto inside = [wraps](long i, long count) { return wraps ? ((i % count) + count) % count : i; };
  for (long r = r0; r <= r1; ++r) {
    const long row = inside(r, rows_);
    if (row < 0 || row >= rows_) continue;
    for (long c = c0; c <= c1; ++c) {
      const long column = inside(c, columns_);
      if (column >= 0 && column < columns_) visit(number_of(column, row));
    }
  }
}

bool ParallelRays::spot(double u, double v, Spot& out) const {
  double x = u - low_.x(), y = v - low_.y();
  if (scene_->domain.periodic) {
    x -= scene_->domain.size_m.x() * std::floor(x / scene_->domain.size_m.x());
    y -= scene_->domain.size_m.y() * std::floor(y / scene_->domain.size_m.y());
  }
  auto column = static_cast<long>(std::floor(x / squares_m_.x())),
       row = static_cast<long>(std::floor(y / squares_m_.y()));
  if (scene_->domain.periodic)
    column = std::clamp(column, 0L, columns_ - 1), row = std::clamp(row, 0L, rows_ - 1);
  if (column < 0 || column >= columns_ || row < 0 || row >= rows_) return false;
  out.square = number_of(column, row);
  out.u = static_cast<float>(x);
  out.v = static_cast<float>(y);
  return true;
}

// `nowhere` outside the ellipse.
float ParallelRays::height_at(const Ellipse& e, float u, float v) const {
  float du = u - e.u, dv = v - e.v;
  if (std::abs(du) > 0.5f * wrap_u_) du -= std::copysign(wrap_u_, du);
  if (std::abs(dv) > 0.5f * wrap_v_) dv -= std::copysign(wrap_v_, dv);
  const float inside = e.q11 * du * du + e.q12 * du * dv + e.q22 * dv * dv;
  return inside <= 1.0f ? e.height + e.a * du + e.b * dv : nowhere;
}

bool ParallelRays::occluded(const Eigen::Vector3f& point, const SurfaceId& from) const {
  const Eigen::Vector3d p = point.cast<double>();
  if (scene_->ground && p.z() < scene_->ground->height_m && from.geometry != TracedScene::ground) return true;
  Spot at{};
  if (!spot(p.x() - p.z() * shear_.x(), p.y() - p.z() * shear_.y(), at)) return false;
  const std::uint32_t skip =
      from.geometry == TracedScene::discs ? first_id_[from.instance] + from.primitive : 0xffffffffu;
  for (std::uint32_t k = first_entry_[at.square]; k < first_entry_[at.square + 1]; ++k) {
    const Entry& entry = entries_[k];
    if (entry.top <= point.z()) return false;
    if (height_at(ellipses_[entry.id], at.u, at.v) > point.z() && entry.id != skip) return true;
  }
  return false;
}

bool ParallelRays::first(const Eigen::Vector3f& point, Hit& hit) const {
  const Eigen::Vector3d p = point.cast<double>();
  const double u = p.x() - p.z() * shear_.x(), v = p.y() - p.z() * shear_.y();
  const float floor = scene_->ground ? static_cast<float>(scene_->ground->height_m) : nowhere;
  float height = floor;
  std::uint32_t id = 0xffffffffu;
  Spot at{};
  if (spot(u, v, at)) {
    for (std::uint32_t k = first_entry_[at.square]; k < first_entry_[at.square + 1]; ++k) {
      const Entry& entry = entries_[k];
      if (entry.top <= height) break;
      const float found = height_at(ellipses_[entry.id], at.u, at.v);
      if (found > height) height = found, id = entry.id;
    }
  }
  if (height == nowhere) return false;
  const auto z = static_cast<double>(height);
  Eigen::Vector3d position(u + z * shear_.x(), v + z * shear_.y(), z);
  if (scene_->domain.periodic)
    for (int axis = 0; axis < 2; ++axis) {
      const double size = scene_->domain.size_m[axis];
      position[axis] -= size * std::floor((position[axis] + 0.5 * size) / size);
    }
  hit.front = true;
  hit.ground = false;
  hit.organ = 0xffffffffu;
  hit.uv.setZero();
  hit.dp_du.setZero();
  hit.dp_dv.setZero();
  hit.position = position.cast<float>();
  hit.distance = static_cast<float>((p.z() - z) / towards_.z());
  if (id == 0xffffffffu) {
    hit.ground = true;
    hit.material = scene_->ground->material;
    hit.geometric_normal = hit.shading_normal = Eigen::Vector3f::UnitZ();
    hit.id = {0, TracedScene::ground, 0};
    hit.extent = 0;
    return true;
  }
  const auto instance = static_cast<std::uint32_t>(std::upper_bound(first_id_.begin(), first_id_.end(), id) -
                                                   first_id_.begin() - 1);
  hit.id = {instance, TracedScene::discs, id - first_id_[instance]};
  const Prototype& prototype = traced_->prototype(instance);
  const Eigen::Vector3d normal =
      traced_->turn(instance, prototype.discs[hit.id.primitive].normal.cast<double>());
  hit.geometric_normal = hit.shading_normal = normal.cast<float>();
  hit.extent = static_cast<float>(traced_->extent(hit.id));
  hit.front = normal.dot(towards_) > 0;
  hit.material = prototype.material_of_disc.empty() ? prototype.disc_material
                                                    : prototype.material_of_disc[hit.id.primitive];
  return true;
}

void ParallelRays::prefetch(const Eigen::Vector3f& point) const {
  const Eigen::Vector3d p = point.cast<double>();
  Spot at{};
  if (!spot(p.x() - p.z() * shear_.x(), p.y() - p.z() * shear_.y(), at)) return;
  __builtin_prefetch(&entries_[first_entry_[at.square]]);
}

std::uint64_t ParallelRays::memory_bytes() const {
  return entries_.size() * sizeof(Entry) + first_entry_.size() * 4 + ellipses_.size() * sizeof(Ellipse);
}

}  // namespace bpms
