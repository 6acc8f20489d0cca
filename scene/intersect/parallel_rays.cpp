#include "scene/intersect/parallel_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
    if (scene.prototypes[instance.prototype].mesh) return nullptr;
  std::unique_ptr<ParallelRays> out(new ParallelRays(traced, scene, towards));
  if (!out->build(most_bytes)) return nullptr;
  return out;
}

ParallelRays::ParallelRays(const TracedScene& traced, const Scene& scene, const Eigen::Vector3d& towards)
    : traced_(&traced), scene_(&scene), towards_(towards), shear_(towards.head<2>() / towards.z()) {}

bool ParallelRays::build(std::uint64_t most_bytes) {
  std::uint64_t count = 0;
  for (const Instance& instance : scene_->instances) {
    first_id_.push_back(static_cast<std::uint32_t>(count));
    count += scene_->prototypes[instance.prototype].discs.size();
  }
  if (count * sizeof(Ellipse) > most_bytes) return false;
  std::vector<Ellipse> ellipses(count);
  const Eigen::Vector3d slope(shear_.x(), shear_.y(), 1);
  for (std::uint32_t i = 0; i < scene_->instances.size(); ++i) {
    const std::vector<Disc>& discs = traced_->prototype(i).discs;
    for (std::size_t k = 0; k < discs.size(); ++k) {
      Ellipse& e = ellipses[first_id_[i] + k];
      const Eigen::Vector3d centre = traced_->place(i, discs[k].centre_m);
      const Eigen::Vector3d normal = traced_->turn(i, discs[k].normal);
      const double radius = scene_->instances[i].scale * static_cast<double>(discs[k].radius_m);
      const double along = normal.dot(slope);
      e.half_u = -1;
      if (std::abs(along) < thinnest * slope.norm()) continue;
      e.u = centre.x() - centre.z() * shear_.x();
      e.v = centre.y() - centre.z() * shear_.y();
      e.height = centre.z();
      e.a = -normal.x() / along;
      e.b = -normal.y() / along;
      const Eigen::Vector3d per_u(1 + e.a * shear_.x(), e.a * shear_.y(), e.a);
      const Eigen::Vector3d per_v(e.b * shear_.x(), 1 + e.b * shear_.y(), e.b);
      const double r2 = radius * radius;
      e.q11 = per_u.squaredNorm() / r2;
      e.q12 = per_u.dot(per_v) / r2;
      e.q22 = per_v.squaredNorm() / r2;
      const double determinant = e.q11 * e.q22 - e.q12 * e.q12;
      e.half_u = std::sqrt(e.q22 / determinant);
      e.half_v = std::sqrt(e.q11 / determinant);
      e.top = e.height + radius * std::sqrt(std::max(0.0, 1 - normal.z() * normal.z()));
      if (scene_->domain.periodic &&
          2 * std::max(e.half_u, e.half_v) > 0.5 * scene_->domain.size_m.minCoeff())
        return false;
    }
  }
  lay_grid(ellipses);

  std::vector<std::uint32_t> listed(squares() + 1, 0);
  std::uint64_t entries = 0;
  for (const Ellipse& e : ellipses) {
    squares_of(e, [&](std::size_t square) {
      ++listed[square + 1];
      ++entries;
    });
  }
  if (entries * sizeof(Block) / 8 > most_bytes || entries > 0xffffffffull) return false;
  for (std::size_t s = 1; s < listed.size(); ++s) listed[s] += listed[s - 1];
  std::vector<std::uint32_t> list(entries), at(listed.begin(), listed.end() - 1);
  for (std::uint32_t id = 0; id < ellipses.size(); ++id)
    squares_of(ellipses[id], [&](std::size_t square) { list[at[square]++] = id; });

  first_block_.push_back(0);
  for (std::size_t square = 0; square + 1 < listed.size(); ++square) {
    const auto begin = list.begin() + listed[square], end = list.begin() + listed[square + 1];
    std::sort(begin, end, [&](std::uint32_t x, std::uint32_t y) {
      return ellipses[x].top != ellipses[y].top ? ellipses[x].top > ellipses[y].top : x < y;
    });
    const long tile_number = static_cast<long>(square) / (tile * tile),
               within = static_cast<long>(square) % (tile * tile);
    const long column = tile_number % tiles_across_ * tile + within % tile;
    const long row = tile_number / tiles_across_ * tile + within / tile;
    const double corner_u = low_.x() + static_cast<double>(column) * squares_m_.x();
    const double corner_v = low_.y() + static_cast<double>(row) * squares_m_.y();
    for (auto from = begin; from < end; from += 8) {
      Block block{};
      for (int k = 0; k < 8; ++k) {
        if (end - from <= k) {
          block.q11[k] = block.q22[k] = 1e30f;
          block.u[k] = block.v[k] = -1e3f;
          block.id[k] = 0xffffffffu;
          continue;
        }
        const std::uint32_t id = *(from + k);
        const Ellipse& e = ellipses[id];
        double u = e.u - corner_u, v = e.v - corner_v;
        if (scene_->domain.periodic) {  // the copy that touches this square
          u -= scene_->domain.size_m.x() * std::round(u / scene_->domain.size_m.x());
          v -= scene_->domain.size_m.y() * std::round(v / scene_->domain.size_m.y());
        }
        block.u[k] = static_cast<float>(u), block.v[k] = static_cast<float>(v);
        block.q11[k] = static_cast<float>(e.q11), block.q12[k] = static_cast<float>(2 * e.q12),
        block.q22[k] = static_cast<float>(e.q22);
        block.height[k] = static_cast<float>(e.height), block.a[k] = static_cast<float>(e.a),
        block.b[k] = static_cast<float>(e.b);
        block.id[k] = id;
      }
      block.top = static_cast<float>(ellipses[*from].top);
      blocks_.push_back(block);
    }
    first_block_.push_back(static_cast<std::uint32_t>(blocks_.size()));
  }
  return true;
}

// Squares about as wide as a disc's radius: short lists, few entries a disc.
void ParallelRays::lay_grid(const std::vector<Ellipse>& ellipses) {
  double extent = 0;
  std::size_t count = 0;
  Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);
  for (const Ellipse& e : ellipses) {
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
void ParallelRays::squares_of(const Ellipse& e, Visit visit) const {
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
  out.u = static_cast<float>(x - static_cast<double>(column) * squares_m_.x());
  out.v = static_cast<float>(y - static_cast<double>(row) * squares_m_.y());
  return true;
}

__attribute__((target_clones("avx2", "default"))) bool ParallelRays::covers(const Block& block, float u,
                                                                            float v, float above,
                                                                            std::uint32_t skip) {
  int any = 0;
  for (int k = 0; k < 8; ++k) {
    const float du = u - block.u[k], dv = v - block.v[k];
    const float inside = block.q11[k] * du * du + block.q12[k] * du * dv + block.q22[k] * dv * dv;
    const float height = block.height[k] + block.a[k] * du + block.b[k] * dv;
    any |= static_cast<int>(inside <= 1.0f) & static_cast<int>(height > above) &
           static_cast<int>(block.id[k] != skip);
  }
  return any != 0;
}

__attribute__((target_clones("avx2", "default"))) void ParallelRays::heights(const Block& block, float u,
                                                                             float v, float* out) {
  for (int k = 0; k < 8; ++k) {
    const float du = u - block.u[k], dv = v - block.v[k];
    const float inside = block.q11[k] * du * du + block.q12[k] * du * dv + block.q22[k] * dv * dv;
    const float height = block.height[k] + block.a[k] * du + block.b[k] * dv;
    out[k] = inside <= 1.0f ? height : nowhere;
  }
}

bool ParallelRays::occluded(const Eigen::Vector3f& point, const SurfaceId& from) const {
  const Eigen::Vector3d p = point.cast<double>();
  if (scene_->ground && p.z() < scene_->ground->height_m && from.geometry != TracedScene::ground) return true;
  Spot at{};
  if (!spot(p.x() - p.z() * shear_.x(), p.y() - p.z() * shear_.y(), at)) return false;
  const std::uint32_t skip =
      from.geometry == TracedScene::discs ? first_id_[from.instance] + from.primitive : 0xffffffffu;
  for (std::uint32_t b = first_block_[at.square]; b < first_block_[at.square + 1]; ++b) {
    const Block& block = blocks_[b];
    if (block.top <= point.z()) return false;
    if (covers(block, at.u, at.v, point.z(), skip)) return true;
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
    for (std::uint32_t b = first_block_[at.square]; b < first_block_[at.square + 1]; ++b) {
      const Block& block = blocks_[b];
      if (block.top <= height) break;
      float found[8];
      heights(block, at.u, at.v, found);
      for (int k = 0; k < 8; ++k)
        if (found[k] > height) height = found[k], id = block.id[k];
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
  hit.position = position.cast<float>();
  hit.distance = static_cast<float>((p.z() - z) / towards_.z());
  if (id == 0xffffffffu) {
    hit.ground = true;
    hit.material = scene_->ground->material;
    hit.geometric_normal = hit.shading_normal = Eigen::Vector3f::UnitZ();
    hit.id = {0, TracedScene::ground, 0};
    return true;
  }
  const auto instance = static_cast<std::uint32_t>(std::upper_bound(first_id_.begin(), first_id_.end(), id) -
                                                   first_id_.begin() - 1);
  hit.id = {instance, TracedScene::discs, id - first_id_[instance]};
  const Prototype& prototype = traced_->prototype(instance);
  const Eigen::Vector3d normal = traced_->turn(instance, prototype.discs[hit.id.primitive].normal);
  hit.geometric_normal = hit.shading_normal = normal.cast<float>();
  hit.front = normal.dot(towards_) > 0;
  hit.material = prototype.disc_material;
  return true;
}

void ParallelRays::prefetch(const Eigen::Vector3f& point) const {
  const Eigen::Vector3d p = point.cast<double>();
  Spot at{};
  if (!spot(p.x() - p.z() * shear_.x(), p.y() - p.z() * shear_.y(), at)) return;
  const std::uint32_t block = first_block_[at.square];
  if (block == first_block_[at.square + 1]) return;
  constexpr std::size_t line = 64;
  const char* from = reinterpret_cast<const char*>(&blocks_[block]);
  for (std::size_t byte = 0; byte < sizeof(Block); byte += line) __builtin_prefetch(from + byte);
}

std::uint64_t ParallelRays::memory_bytes() const {
  return blocks_.size() * sizeof(Block) + first_block_.size() * 4;
}

}  // namespace bpms
