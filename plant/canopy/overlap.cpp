#include "plant/canopy/overlap.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "plant/canopy/plant_shape.h"
#include "plant/plant_mesh.h"

namespace bpms {
// Plants by the cell of their sphere's centre, in a periodic canopy put back into the domain.
struct PlantCrossings::Impl {
  std::vector<PlantShape> shapes;
  std::vector<Placement> placements;
  std::vector<BoundSphere> spheres;  // of the placements
  bool periodic = true;
  Eigen::Vector2d size_m, low_m;
  double largest_radius = 0, cell_m[2] = {1, 1};
  long long count[2] = {1, 1};
  std::vector<std::vector<std::uint32_t>> cells;

  PlacedShape placed(const Placement& p) const { return {shapes[p.plant], p}; }
  BoundSphere sphere(const Placement& p) const {
    const PlacedShape shape = placed(p);
    return shape.sphere(shape.shape->sphere);
  }
  // The whole periods that a place lies away from the domain.
  Eigen::Vector2d periods(const Eigen::Vector2d& xy) const {
    if (!periodic) return Eigen::Vector2d::Zero();
    return (xy - low_m).cwiseQuotient(size_m).array().floor();
  }
  long long index(double at, int k) const {
    constexpr double farthest = 1e9;
    return static_cast<long long>(std::clamp(std::floor((at - low_m[k]) / cell_m[k]), -farthest, farthest));
  }
  std::size_t home(std::size_t i) const {
    const Eigen::Vector2d xy = spheres[i].centre.head<2>();
    const Eigen::Vector2d in = xy - periods(xy).cwiseProduct(size_m);
    const long long x = std::clamp(index(in.x(), 0), 0LL, count[0] - 1),
                    y = std::clamp(index(in.y(), 1), 0LL, count[1] - 1);
    return static_cast<std::size_t>(y * count[0] + x);
  }
  void make_cells(const Canopy& canopy);
  template <class Visit>
  void visit_neighbours(std::size_t i, const Placement& there, const Visit& visit) const;
  template <class Visit>
  void visit_own_images(const BoundSphere& mine, const Placement& there, const Visit& visit) const;
  Area crossing(std::size_t i, const Placement& there) const;
};

void PlantCrossings::Impl::make_cells(const Canopy& canopy) {
  periodic = canopy.periodic;
  size_m = canopy.size_m, low_m = -0.5 * canopy.size_m;
  Eigen::AlignedBox2d box;
  for (const Placement& p : placements) {
    const BoundSphere around_it = sphere(p);
    spheres.push_back(around_it);
    largest_radius = std::max(largest_radius, around_it.radius);
    box.extend(Eigen::Vector2d(around_it.centre.head<2>()));
  }
  if (!periodic && !placements.empty()) low_m = box.min(), size_m = box.sizes().cwiseMax(1e-9);
  const double crowd =
      std::sqrt(size_m.prod() / static_cast<double>(std::max<std::size_t>(1, placements.size())));
  for (int k = 0; k < 2; ++k) {
    constexpr double most = 4096;
    count[k] = static_cast<long long>(std::clamp(size_m[k] / std::max(crowd, largest_radius), 1.0, most));
    cell_m[k] = size_m[k] / static_cast<double>(count[k]);
  }
  cells.resize(static_cast<std::size_t>(count[0] * count[1]));
  for (std::size_t i = 0; i < placements.size(); ++i) cells[home(i)].push_back(static_cast<std::uint32_t>(i));
}

// visit(placement of another plant or of an image of any) for all whose spheres meet that of plant i there.
// Plant i's own images stand as it does.
template <class Visit>
void PlantCrossings::Impl::visit_neighbours(std::size_t i, const Placement& there, const Visit& visit) const {
  const BoundSphere mine = sphere(there);
  const double reach = mine.radius + largest_radius;
  const auto from = [&](int k) { return index(mine.centre[k] - reach, k); };
  const auto to = [&](int k) { return index(mine.centre[k] + reach, k); };
  const auto wrapped = [&](long long at, int k) { return ((at % count[k]) + count[k]) % count[k]; };
  const auto clamped = [&](long long at, int k) { return periodic ? at : std::clamp(at, 0LL, count[k] - 1); };
  for (long long y = clamped(from(1), 1); y <= clamped(to(1), 1); ++y) {
    for (long long x = clamped(from(0), 0); x <= clamped(to(0), 0); ++x) {
      const long long cell_x = wrapped(x, 0), cell_y = wrapped(y, 1);
      const long long periods_x = (x - cell_x) / count[0], periods_y = (y - cell_y) / count[1];  // whole
      const Eigen::Vector2d cell_period(static_cast<double>(periods_x), static_cast<double>(periods_y));
      for (const std::uint32_t j : cells[static_cast<std::size_t>(cell_y * count[0] + cell_x)]) {
        if (j == i) continue;
        Eigen::Vector3d by = Eigen::Vector3d::Zero();
        if (periodic)
          by.head<2>() = (cell_period - periods(spheres[j].centre.head<2>())).cwiseProduct(size_m);
        if (!mine.meets({spheres[j].centre + by, spheres[j].radius})) continue;
        Placement other = placements[j];
        other.position_m += by;
        visit(other);
      }
    }
  }
  if (periodic) visit_own_images(mine, there, visit);
}

template <class Visit>
void PlantCrossings::Impl::visit_own_images(const BoundSphere& mine, const Placement& there,
                                            const Visit& visit) const {
  const auto most = [&](int k) { return static_cast<int>(2 * mine.radius / size_m[k]); };
  for (int y = -most(1); y <= most(1); ++y) {
    for (int x = -most(0); x <= most(0); ++x) {
      if (x == 0 && y == 0) continue;
      Placement image = there;
      image.position_m.head<2>() += Eigen::Vector2d(x, y).cwiseProduct(size_m);
      if (mine.meets(sphere(image))) visit(image);
    }
  }
}

PlantCrossings::Area PlantCrossings::Impl::crossing(std::size_t i, const Placement& there) const {
  const PlacedShape own = placed(there);
  std::vector<char> of_own(own.shape->triangles.size(), 0), of_other;
  Area out;
  visit_neighbours(i, there, [&](const Placement& at) {
    const PlacedShape other = placed(at);
    of_other.assign(other.shape->triangles.size(), 0);
    // Near the plants themselves: coordinates far from the origin would lose digits.
    PlacedShape a = own, b = other;
    b.at -= a.at;
    a.at.setZero();
    mark_crossing(a, b, of_own, of_other);
    out.others_m2 += marked_leaf_area_m2(other, of_other);
  });
  out.own_m2 = marked_leaf_area_m2(own, of_own);
  return out;
}

PlantCrossings::PlantCrossings(const Canopy& canopy) : impl_(std::make_unique<Impl>()) {
  impl_->placements = canopy.placements;
  impl_->shapes.resize(canopy.plants.size());
  parallel_for(canopy.plants.size(),
               [&](std::size_t p) { impl_->shapes[p] = plant_shape(*canopy.plants[p].mesh); });
  impl_->make_cells(canopy);
}
PlantCrossings::~PlantCrossings() = default;

PlantCrossings::Area PlantCrossings::crossing(std::size_t i) const {
  return impl_->crossing(i, impl_->placements[i]);
}
PlantCrossings::Area PlantCrossings::crossing(std::size_t i, const Placement& there) const {
  return impl_->crossing(i, there);
}

void PlantCrossings::move(std::size_t i, const Placement& there) {
  std::vector<std::uint32_t>& before = impl_->cells[impl_->home(i)];
  before.erase(std::find(before.begin(), before.end(), static_cast<std::uint32_t>(i)));
  impl_->placements[i] = there;
  impl_->spheres[i] = impl_->sphere(there);
  impl_->cells[impl_->home(i)].push_back(static_cast<std::uint32_t>(i));
}

std::vector<double> PlantCrossings::own_m2() const {
  std::vector<double> out(impl_->placements.size());
  constexpr std::size_t batch = 16;
  parallel_for((out.size() + batch - 1) / batch, [&](std::size_t b) {
    for (std::size_t i = b * batch; i < std::min(out.size(), (b + 1) * batch); ++i)
      out[i] = crossing(i).own_m2;
  });
  return out;
}

double PlantCrossings::largest_radius_m() const {
  return impl_->largest_radius;
}

double PlantCrossings::leaf_area_m2() const {
  double out = 0;
  for (const Placement& p : impl_->placements) out += p.scale * p.scale * impl_->shapes[p.plant].leaf_area_m2;
  return out;
}

void make_canopy_meshes(Canopy& canopy) {
  parallel_for(canopy.plants.size(), [&](std::size_t i) {
    CanopyPlant& plant = canopy.plants[i];
    if (!plant.mesh) plant.mesh = std::make_shared<const Mesh>(plant_mesh(*plant.plant));
  });
}

double overlap_fraction(const Canopy& canopy) {
  const PlantCrossings crossings(canopy);
  const std::vector<double> own = crossings.own_m2();
  const double leaf_m2 = crossings.leaf_area_m2();
  return leaf_m2 > 0 ? std::accumulate(own.begin(), own.end(), 0.0) / leaf_m2 : 0;
}

}  // namespace bpms
