#include "plant/canopy/overlap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "plant/canopy/triangle_crossing.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

struct BoundSphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;
  bool meets(const BoundSphere& other) const {
    const double reach = radius + other.radius;
    return (centre - other.centre).squaredNorm() < reach * reach;
  }
};

// Triangles that follow each other on an organ.
struct TriangleRun {
  BoundSphere sphere;
  std::uint32_t first = 0, count = 0;  // of PlantShape::triangles
};
struct OrganShape {
  BoundSphere sphere;
  bool leaf = false;
  std::uint32_t first = 0, count = 0;  // of PlantShape::runs
};

// A plant's triangles by organ, with spheres around organs and runs.
struct PlantShape {
  BoundSphere sphere;
  std::vector<OrganShape> organs;
  std::vector<TriangleRun> runs;
  std::vector<TriangleCorners> triangles;
  std::vector<double> area_m2;
  double leaf_area_m2 = 0;
};

BoundSphere sphere_around(const TriangleCorners* first, std::size_t count) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < count; ++i)
    for (const Eigen::Vector3d& corner : first[i]) box.extend(corner);
  BoundSphere out{box.center(), 0};
  for (std::size_t i = 0; i < count; ++i)
    for (const Eigen::Vector3d& corner : first[i])
      out.radius = std::max(out.radius, (corner - out.centre).norm());
  return out;
}

PlantShape shape_of(const Mesh& mesh) {
  constexpr std::uint32_t triangles_a_run = 8;
  PlantShape out;
  std::vector<std::uint32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return mesh.organ_of_triangle[a] < mesh.organ_of_triangle[b];
  });
  for (const std::uint32_t t : order) {
    TriangleCorners corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.positions_m[mesh.triangles[t][k]].cast<double>();
    out.triangles.push_back(corners);
    out.area_m2.push_back(0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm());
  }
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    const std::uint32_t organ = mesh.organ_of_triangle[order[begin]];
    while (end < order.size() && mesh.organ_of_triangle[order[end]] == organ) ++end;
    OrganShape shape{sphere_around(&out.triangles[begin], end - begin), mesh.organs[organ].kind == "leaf",
                     static_cast<std::uint32_t>(out.runs.size()), 0};
    for (std::size_t at = begin; at < end; at += triangles_a_run) {
      const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(triangles_a_run, end - at));
      out.runs.push_back({sphere_around(&out.triangles[at], count), static_cast<std::uint32_t>(at), count});
      ++shape.count;
    }
    for (std::size_t t = begin; t < end && shape.leaf; ++t) out.leaf_area_m2 += out.area_m2[t];
    out.organs.push_back(shape);
  }
  if (!out.triangles.empty()) out.sphere = sphere_around(out.triangles.data(), out.triangles.size());
  return out;
}

// A plant's shape where it stands.
struct PlacedShape {
  const PlantShape* shape = nullptr;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  // scale included
  double scale = 1;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();

  PlacedShape(const PlantShape& of, const Placement& p) : shape(&of), scale(p.scale), at(p.position_m) {
    turn = p.scale * (Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), p.up.cast<double>()) *
                      Eigen::AngleAxisd(p.rotation, Eigen::Vector3d::UnitZ()))
                         .toRotationMatrix();
  }
  BoundSphere sphere(const BoundSphere& own) const { return {turn * own.centre + at, scale * own.radius}; }
  TriangleCorners triangle(std::size_t t) const {
    const TriangleCorners& own = shape->triangles[t];
    return {turn * own[0] + at, turn * own[1] + at, turn * own[2] + at};
  }
};

// Which triangles of two plants cross: marks those of a in one list, those of b in the other.
class CrossingPair {
 public:
  CrossingPair(const PlacedShape& a, const PlacedShape& b, std::vector<char>& of_a, std::vector<char>& of_b)
      : a_(a), b_(b), of_a_(of_a), of_b_(of_b) {}
  void mark() {
    const BoundSphere whole_b = b_.sphere(b_.shape->sphere), whole_a = a_.sphere(a_.shape->sphere);
    for (const OrganShape& organ_a : a_.shape->organs) {
      const BoundSphere sphere_a = a_.sphere(organ_a.sphere);
      if (!sphere_a.meets(whole_b)) continue;
      for (const OrganShape& organ_b : b_.shape->organs) {
        if (!organ_a.leaf && !organ_b.leaf) continue;
        const BoundSphere sphere_b = b_.sphere(organ_b.sphere);
        if (sphere_b.meets(whole_a) && sphere_a.meets(sphere_b)) mark_organs(organ_a, organ_b, sphere_b);
      }
    }
  }

 private:
  void mark_organs(const OrganShape& organ_a, const OrganShape& organ_b, const BoundSphere& sphere_b) {
    for (std::uint32_t i = 0; i < organ_a.count; ++i) {
      const TriangleRun& run_a = a_.shape->runs[organ_a.first + i];
      const BoundSphere around_a = a_.sphere(run_a.sphere);
      if (!around_a.meets(sphere_b)) continue;
      for (std::uint32_t j = 0; j < organ_b.count; ++j) {
        const TriangleRun& run_b = b_.shape->runs[organ_b.first + j];
        if (around_a.meets(b_.sphere(run_b.sphere))) mark_runs(run_a, run_b);
      }
    }
  }
  void mark_runs(const TriangleRun& run_a, const TriangleRun& run_b) {
    TriangleCorners triangles_b[8];
    for (std::uint32_t j = 0; j < run_b.count; ++j) triangles_b[j] = b_.triangle(run_b.first + j);
    for (std::uint32_t i = run_a.first; i < run_a.first + run_a.count; ++i) {
      const TriangleCorners triangle_a = a_.triangle(i);
      for (std::uint32_t j = 0; j < run_b.count; ++j) {
        if (of_a_[i] != 0 && of_b_[run_b.first + j] != 0) continue;
        if (triangles_cross(triangle_a, triangles_b[j])) of_a_[i] = of_b_[run_b.first + j] = 1;
      }
    }
  }
  const PlacedShape &a_, &b_;
  std::vector<char>&of_a_, &of_b_;
};

double marked_leaf_area_m2(const PlacedShape& of, const std::vector<char>& marked) {
  double out = 0;
  for (const OrganShape& organ : of.shape->organs) {
    if (!organ.leaf) continue;
    const TriangleRun &first = of.shape->runs[organ.first],
                      &last = of.shape->runs[organ.first + organ.count - 1];
    for (std::uint32_t t = first.first; t < last.first + last.count; ++t)
      if (marked[t] != 0) out += of.shape->area_m2[t];
  }
  return out * of.scale * of.scale;
}

}  // namespace

// Plants by the cell of their sphere's centre, in a periodic canopy put back into the domain.
struct PlantCrossings::Impl {
  std::vector<PlantShape> shapes;
  std::vector<std::uint32_t> shape_of_plant;
  std::vector<Placement> placements;
  bool periodic = true;
  Eigen::Vector2d size_m, low_m;
  double largest_radius = 0, cell_m[2] = {1, 1};
  long long count[2] = {1, 1};
  std::vector<std::vector<std::uint32_t>> cells;

  PlacedShape placed(const Placement& p) const { return {shapes[shape_of_plant[p.plant]], p}; }
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
    return static_cast<long long>(std::floor((at - low_m[k]) / cell_m[k]));
  }
  std::size_t home(const Placement& p) const {
    const Eigen::Vector2d xy = sphere(p).centre.head<2>();
    const Eigen::Vector2d in = xy - periods(xy).cwiseProduct(size_m);
    const long long i = std::clamp(index(in.x(), 0), 0LL, count[0] - 1),
                    j = std::clamp(index(in.y(), 1), 0LL, count[1] - 1);
    return static_cast<std::size_t>(j * count[0] + i);
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
  for (std::size_t i = 0; i < placements.size(); ++i)
    cells[home(placements[i])].push_back(static_cast<std::uint32_t>(i));
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
      const Eigen::Vector2d cell_period(static_cast<double>((x - cell_x) / count[0]),
                                        static_cast<double>((y - cell_y) / count[1]));
      for (const std::uint32_t j : cells[static_cast<std::size_t>(cell_y * count[0] + cell_x)]) {
        if (j == i) continue;
        Placement other = placements[j];
        if (periodic) {
          const Eigen::Vector2d own_period = periods(sphere(placements[j]).centre.head<2>());
          other.position_m.head<2>() += (cell_period - own_period).cwiseProduct(size_m);
        }
        if (mine.meets(sphere(other))) visit(other);
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
    CrossingPair(a, b, of_own, of_other).mark();
    out.others_m2 += marked_leaf_area_m2(other, of_other);
  });
  out.own_m2 = marked_leaf_area_m2(own, of_own);
  return out;
}

PlantCrossings::PlantCrossings(const Canopy& canopy) : impl_(std::make_unique<Impl>()) {
  impl_->placements = canopy.placements;
  impl_->shapes.resize(canopy.plants.size());
  impl_->shape_of_plant.resize(canopy.plants.size());
  std::iota(impl_->shape_of_plant.begin(), impl_->shape_of_plant.end(), 0u);
  parallel_for(canopy.plants.size(),
               [&](std::size_t p) { impl_->shapes[p] = shape_of(*canopy.plants[p].mesh); });
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
  std::vector<std::uint32_t>& before = impl_->cells[impl_->home(impl_->placements[i])];
  before.erase(std::find(before.begin(), before.end(), static_cast<std::uint32_t>(i)));
  impl_->placements[i] = there;
  impl_->cells[impl_->home(there)].push_back(static_cast<std::uint32_t>(i));
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

double PlantCrossings::leaf_area_m2() const {
  double out = 0;
  for (const Placement& p : impl_->placements)
    out += p.scale * p.scale * impl_->shapes[impl_->shape_of_plant[p.plant]].leaf_area_m2;
  return out;
}

void make_canopy_meshes(Canopy& canopy) {
  parallel_for(canopy.plants.size(), [&](std::size_t i) {
    CanopyPlant& plant = canopy.plants[i];
    if (!plant.mesh) plant.mesh = std::make_shared<const Mesh>(plant_mesh(*plant.plant));
  });
}

}  // namespace bpms
