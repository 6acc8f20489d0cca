#include "scene/intersect/disc_grid.h"

#include <xmmintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/intersect/traced_scene.h"

namespace bpms {
namespace {

constexpr std::size_t least_discs = 1000;  // the hierarchy of fewer fits into the nearest cache
constexpr double discs_a_cell = 14;        // measured: 6 to 20 are equally fast, 2 to 4 up to twice as slow
constexpr double least_filled = 0.4;       // of the cells
constexpr int most_cells_a_side = 2000;
constexpr float hair = 2e-6f;  // of a place's size: what floats round, several times over

// Mean number of discs that touch a cell, by its side: the mean volume of a cube and a disc added to each
// other in all orientations (Steiner's formula for mixed volumes), times discs per volume.
double mean_touching(double side, double density, double mean_width, double mean_surface) {
  return density * (side * side * side + 3 * side * side * mean_width + 0.75 * side * mean_surface);
}

}  // namespace

std::unique_ptr<DiscGrid> DiscGrid::make(const TracedScene& traced, const Scene& scene,
                                         std::uint64_t most_bytes) {
  std::size_t discs = 0;
  for (const Instance& instance : scene.instances) {
    const Prototype& prototype = scene.prototypes[instance.prototype];
    if (prototype.mesh || !prototype.shapes.empty()) return nullptr;
    discs += prototype.discs.size();
  }
  if (scene.ground && scene.ground->terrain) return nullptr;
  // Each stands in some four cells.
  if (discs < least_discs || discs > most_bytes / (4 * sizeof(Packet) / wide)) return nullptr;
  std::unique_ptr<DiscGrid> out(new DiscGrid(traced, scene));
  if (!out->build(most_bytes)) return nullptr;
  return out;
}

DiscGrid::DiscGrid(const TracedScene& traced, const Scene& scene)
    : periodic_(scene.domain.periodic),
      low_(traced.box().low),
      high_(traced.box().high),
      size_(scene.domain.size_m) {
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    first_id_.push_back(static_cast<std::uint32_t>(discs_.size()));
    for (const Disc& own : traced.prototype(i).discs) {
      const Eigen::Vector3d centre = traced.place(i, own.centre_m.cast<double>()),
                            normal = traced.turn(i, own.normal.cast<double>());
      const double radius = scene.instances[i].scale * static_cast<double>(own.radius_m);
      discs_.push_back({centre.cast<float>(), static_cast<float>(radius), normal.cast<float>()});
      widest_ = std::max(widest_, 2 * radius);
    }
  }
}

bool DiscGrid::build(std::uint64_t most_bytes) {
  if (periodic_ && 2 * widest_ > size_.minCoeff()) return false;
  const Eigen::Vector3d extent = high_ - low_;
  if (!(extent.minCoeff() > 0)) return false;
  double width = 0, surface = 0;
  for (const Disc& disc : discs_) {
    const auto r = static_cast<double>(disc.radius_m);
    width += std::numbers::pi / 2 * r;
    surface += 2 * std::numbers::pi * r * r;
  }
  const auto count = static_cast<double>(discs_.size());
  const double density = count / extent.prod();
  double least = 0, most = extent.maxCoeff();
  for (int step = 0; step < 50; ++step) {
    const double side = 0.5 * (least + most);
    (mean_touching(side, density, width / count, surface / count) < discs_a_cell ? least : most) = side;
  }
  choose_cells(most);

  const std::size_t cells = static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) *
                            static_cast<std::size_t>(cells_[2]);
  std::vector<std::uint32_t> touching(cells, 0);
  each_copy([&](const Copy& copy) { cells_of(copy, [&](std::size_t cell) { ++touching[cell]; }); });
  std::size_t filled = 0;
  first_packet_.assign(cells + 1, 0);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    filled += touching[cell] > 0 ? 1 : 0;
    constexpr auto lanes = static_cast<std::uint32_t>(wide);
    first_packet_[cell + 1] = first_packet_[cell] + (touching[cell] + lanes - 1) / lanes;
  }
  if (static_cast<double>(filled) < least_filled * static_cast<double>(cells)) return false;
  if (first_packet_.back() * (sizeof(Packet) + sizeof(ids_[0])) > most_bytes) return false;
  Packet empty{};
  empty.nz += 1.0f;
  empty.radius2 -= 1.0f;
  packets_.assign(first_packet_.back(), empty);
  ids_.assign(packets_.size(), {});
  std::fill(touching.begin(), touching.end(), 0u);
  each_copy([&](const Copy& copy) {
    const Disc& disc = discs_[copy.disc];
    cells_of(copy, [&](std::size_t cell) {
      const std::size_t i = touching[cell] % wide, number = first_packet_[cell] + touching[cell] / wide;
      Packet& to = packets_[number];
      to.x[i] = copy.centre.x(), to.y[i] = copy.centre.y(), to.z[i] = copy.centre.z();
      to.nx[i] = disc.normal.x(), to.ny[i] = disc.normal.y(), to.nz[i] = disc.normal.z();
      to.radius2[i] = disc.radius_m * disc.radius_m;
      ids_[number][i] = copy.disc;
      ++touching[cell];
    });
  });
  discs_ = {};
  return true;
}

void DiscGrid::choose_cells(double side) {
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = high_[axis] - low_[axis];
    cells_[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::clamp(std::round(extent / side), 1.0, double{most_cells_a_side}));
    cell_m_[axis] = static_cast<float>(extent / cells_[static_cast<std::size_t>(axis)]);
  }
  per_m_ = cell_m_.cwiseInverse();
  low_f_ = low_.cast<float>();
}

// With those shifted by whole periods that reach into the box.
template <class Visit>
void DiscGrid::each_copy(Visit visit) const {
  for (std::uint32_t i = 0; i < discs_.size(); ++i) {
    const Disc& disc = discs_[i];
    if (!periodic_) {
      visit(Copy{disc.centre_m, i});
      continue;
    }
    // An instance may stand some periods away from the cell.
    const double reach = static_cast<double>(disc.radius_m) * (1 + 1e-5);
    const Eigen::Array2d centre = disc.centre_m.head<2>().cast<double>().array(), size = size_.array();
    const Eigen::Array2d first = ((low_.head<2>().array() - reach - centre) / size).ceil(),
                         last = ((high_.head<2>().array() + reach - centre) / size).floor();
    for (double y = first.y(); y <= last.y(); ++y)
      for (double x = first.x(); x <= last.x(); ++x)
        visit(Copy{
            (disc.centre_m.cast<double>() + Eigen::Vector3d(x * size.x(), y * size.y(), 0)).cast<float>(),
            i});
  }
}

// The cells that a disc touches, and perhaps a few more at its rim.
template <class Visit>
void DiscGrid::cells_of(const Copy& copy, Visit visit) const {
  const Disc& disc = discs_[copy.disc];
  const Eigen::Vector3f about = copy.centre - low_f_;
  const float slack = hair * (copy.centre.cwiseAbs().maxCoeff() + low_f_.cwiseAbs().maxCoeff());
  std::array<int, 3> from{}, to{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    // 1 - n^2 is off by 1e-7, its root by up to 1e-3.
    constexpr float tilt = 1e-3f;
    const float n = disc.normal[axis],
                half = disc.radius_m * (std::sqrt(std::max(0.0f, 1 - n * n)) + tilt) + slack;
    from[a] = std::clamp(static_cast<int>(std::floor((about[axis] - half) * per_m_[axis])), 0, cells_[a] - 1);
    to[a] = std::clamp(static_cast<int>(std::floor((about[axis] + half) * per_m_[axis])), 0, cells_[a] - 1);
  }
  const float reach = 0.5f * disc.normal.cwiseAbs().dot(cell_m_) + slack;
  for (int z = from[2]; z <= to[2]; ++z)
    for (int y = from[1]; y <= to[1]; ++y)
      for (int x = from[0]; x <= to[0]; ++x) {
        const Eigen::Vector3f middle =
            (Eigen::Array3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)) + 0.5f) *
            cell_m_.array();
        if (std::abs(disc.normal.dot(about - middle)) > reach) continue;
        visit((static_cast<std::size_t>(z) * static_cast<std::size_t>(cells_[1]) +
               static_cast<std::size_t>(y)) *
                  static_cast<std::size_t>(cells_[0]) +
              static_cast<std::size_t>(x));
      }
}

// From `origin` to the side of the box where it leaves, or to the first disc. `near`: nearest disc so far.
struct DiscGrid::Walk {
  float origin[3], direction[3];
  float near;
  float own_reach;  // hits on `skip` nearer than this are none
  std::uint32_t skip;
  bool any, met;
  std::uint32_t packet, place;  // of the disc met
  int side;                     // the axis it leaves along, or -1 where it ended inside
  float side_at;
};

__attribute__((target_clones("arch=x86-64-v3", "default"))) void DiscGrid::walk(Walk& w) const {
  using Ints = int __attribute__((vector_size(4 * wide)));
  using Four = int __attribute__((vector_size(16)));
  const float ox = w.origin[0], oy = w.origin[1], oz = w.origin[2];
  const float dx = w.direction[0], dy = w.direction[1], dz = w.direction[2];
  constexpr float never = 1e30f, slowest = 1e-18f;
  // Bits: x <= y, x <= z, y <= z.
  constexpr std::uint8_t first_axis[8] = {2, 2, 1, 0, 1, 0, 1, 0};
  float next[3], by[3];
  int left[3];
  std::ptrdiff_t step[3], at = 0, stride = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const float from = w.origin[a] - low_f_[axis];
    const int cell = std::clamp(static_cast<int>(from * per_m_[axis]), 0, cells_[a] - 1);
    at += cell * stride;
    // Without branches: signs are not foreseen either. What runs along an axis not at all gets there late.
    const float d = w.direction[a];
    const int up = static_cast<int>(d > 0), way = 2 * up - 1;
    const float inverse = static_cast<float>(way) / std::max(std::abs(d), slowest);
    left[a] = cell + up * (cells_[a] - 1 - 2 * cell);
    step[a] = stride * way;
    next[a] = (static_cast<float>(cell + up) * cell_m_[axis] - from) * inverse;
    by[a] = cell_m_[axis] * std::abs(inverse);
    stride *= cells_[a];
  }
  float near = w.near;
  w.side = -1;
  for (;;) {
    const std::uint32_t last = first_packet_[static_cast<std::size_t>(at) + 1];
    for (std::uint32_t k = first_packet_[static_cast<std::size_t>(at)]; k < last; ++k) {
      const Packet& p = packets_[k];
      const Floats px = p.x - ox, py = p.y - oy, pz = p.z - oz;
      const Floats t = (p.nx * px + p.ny * py + p.nz * pz) / (p.nx * dx + p.ny * dy + p.nz * dz);
      const Floats qx = t * dx - px, qy = t * dy - py, qz = t * dz - pz;
      const Ints met = (qx * qx + qy * qy + qz * qz <= p.radius2) & (t > 0.0f) & (t < near);
      const Four low = __builtin_shufflevector(met, met, 0, 1, 2, 3),
                 high = __builtin_shufflevector(met, met, 4, 5, 6, 7);
      auto places = static_cast<unsigned>(_mm_movemask_ps((__m128)low) | _mm_movemask_ps((__m128)high) << 4);
      for (; places != 0; places &= places - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(places));
        if (!(t[i] < near) || (ids_[k][i] == w.skip && t[i] < w.own_reach)) continue;
        near = w.any ? -never : t[i];
        w.met = true;
        w.packet = k, w.place = i;
      }
    }
    // By table: which side comes first is a branch that no processor foresees.
    const unsigned order = static_cast<unsigned>(next[0] <= next[1]) |
                           static_cast<unsigned>(next[0] <= next[2]) << 1 |
                           static_cast<unsigned>(next[1] <= next[2]) << 2;
    const std::size_t axis = first_axis[order];
    const float out = next[axis];
    if (near <= out) break;
    at += step[axis];
    next[axis] = out + by[axis];
    if (--left[axis] < 0) {
      w.side = static_cast<int>(axis);
      w.side_at = out;
      break;
    }
  }
  w.near = near;
}

DiscGrid::End DiscGrid::first(const Query& query, Found& found) const {
  Eigen::Vector3d origin = query.origin;
  double before = 0;
  const auto advance = [&](double length) {
    origin += length * query.direction;
    before += length;
  };
  // Up to the box; a period has no sides.
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  for (int axis = periodic_ ? 2 : 0; axis < 3; ++axis) {
    if (origin[axis] >= low_[axis] && origin[axis] <= high_[axis] && periodic_) continue;
    const double d = query.direction[axis];
    if (d == 0) {
      if (origin[axis] < low_[axis] || origin[axis] > high_[axis]) return End::side;
      continue;
    }
    const double a = (low_[axis] - origin[axis]) / d, b = (high_[axis] - origin[axis]) / d;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter > leave) return End::side;
  if (enter >= query.far) return End::far;
  if (enter > 0) {
    advance(enter);
    if (periodic_)
      for (int axis = 0; axis < 2; ++axis)
        origin[axis] -= size_[axis] * std::floor((origin[axis] - low_[axis]) / size_[axis]);
  }
  Walk w;
  w.met = false;
  w.skip = query.skip;
  w.any = query.any;
  for (int axis = 0; axis < 3; ++axis) w.direction[axis] = static_cast<float>(query.direction[axis]);
  w.near = static_cast<float>(query.far - before);
  for (int wraps = 0;; ++wraps) {
    for (int axis = 0; axis < 3; ++axis) w.origin[axis] = static_cast<float>(origin[axis]);
    // A ray leaves its own disc for good, but for copies of it that are further than it is wide.
    w.own_reach = static_cast<float>(widest_ - before);
    walk(w);
    if (w.side < 0) {
      if (!w.met) return End::far;
      break;
    }
    if (w.side == 2 || !periodic_) {
      if (!w.met) return End::side;
      break;  // met beyond the side, by rounding
    }
    if (wraps >= query.max_wraps) return End::wraps;
    const auto length = static_cast<double>(w.side_at);
    advance(length);
    origin[w.side] -= std::copysign(size_[w.side], query.direction[w.side]);
    w.near = std::max(0.0f, w.near - w.side_at);
  }
  if (query.any) return End::disc;
  const Packet& p = packets_[w.packet];
  const std::size_t i = w.place;
  const std::uint32_t disc = ids_[w.packet][i];
  found.instance = 0;
  if (first_id_.size() > 1)
    found.instance = static_cast<std::uint32_t>(std::upper_bound(first_id_.begin(), first_id_.end(), disc) -
                                                first_id_.begin() - 1);
  found.primitive = disc - first_id_[found.instance];
  const Eigen::Vector3d centre(p.x[i], p.y[i], p.z[i]);
  found.normal = {p.nx[i], p.ny[i], p.nz[i]};
  found.radius = static_cast<double>(std::sqrt(p.radius2[i]));
  // In the disc's own plane: origin + t d is off it by t's rounding.
  const auto t = static_cast<double>(w.near);
  Eigen::Vector3d offset = origin - centre + t * query.direction;
  if (periodic_)  // it was met from the other side of a side, perhaps
    for (int axis = 0; axis < 2; ++axis)
      if (std::abs(offset[axis]) > widest_) offset[axis] -= std::copysign(size_[axis], offset[axis]);
  found.position = centre + offset - offset.dot(found.normal) * found.normal;
  found.distance = before + t;
  return End::disc;
}

std::uint64_t DiscGrid::memory_bytes() const {
  return discs_.size() * sizeof(Disc) + packets_.size() * (sizeof(Packet) + sizeof(ids_[0])) +
         first_packet_.size() * 4;
}

}  // namespace bpms
