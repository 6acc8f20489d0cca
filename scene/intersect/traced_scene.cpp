#include "scene/intersect/traced_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "scene/geometry/cluster_order.h"

namespace bpms {

TracedScene::TracedScene(const Scene& scene, const IntersectorOptions& options)
    : top_(device_),
      prototypes_(scene.prototypes),
      instances_(scene.instances),
      periodic_(scene.domain.periodic),
      size_(scene.domain.size_m) {
  if (periodic_ && !(size_.minCoeff() > 0))
    throw Error(ErrorKind::bad_input, "a periodic domain needs a size (domain.size_m)");
  sort_discs();
  make_triangle_normals();
  std::vector<Box> prototype_bounds, instance_bounds;
  for (const Prototype& prototype : prototypes_) prototype_bounds.push_back(bounds(prototype));
  for (const Instance& instance : instances_) {
    rotations_.push_back({std::cos(instance.rotation), std::sin(instance.rotation)});
    instance_bounds.push_back(bounds(prototype_bounds[instance.prototype], instance));
    box_.include(instance_bounds.back());
  }
  if (periodic_) {
    // A hair more, so that no rounding opens a gap where a ray changes sides.
    const double slack =
        1e-5 * (size_.maxCoeff() + (box_.empty() ? 0 : std::abs(box_.low.z()) + std::abs(box_.high.z())));
    complete_low_ = (-0.5 * size_).array() - slack;
    complete_high_ = (0.5 * size_).array() + slack;
    box_.low.head<2>() = -0.5 * size_;
    box_.high.head<2>() = 0.5 * size_;
  }
  make_copies(instance_bounds);
  choose_layout(options);
  prototype_bvh_.resize(prototypes_.size());
  for (std::uint32_t k = 0; k < copies_.size(); ++k) {
    if (copies_[k].flat) {
      add_flat_discs(k);
      add_flat_triangles(k);
    } else {
      add_instance(k);
    }
  }
  top_.commit();
}

void TracedScene::sort_discs() {
  for (Prototype& prototype : prototypes_) {
    std::vector<Eigen::Vector3f> centres;
    for (const Disc& disc : prototype.discs) centres.push_back(disc.centre_m);
    std::vector<Disc> sorted;
    sorted.reserve(centres.size());
    for (const std::uint32_t k : cluster_order(centres, embree::DiscClusters::wide))
      sorted.push_back(prototype.discs[k]);
    prototype.discs = std::move(sorted);
  }
}

void TracedScene::make_triangle_normals() {
  for (const Prototype& prototype : prototypes_) {
    std::vector<Eigen::Vector3f>& normals = triangle_normals_.emplace_back();
    if (!prototype.mesh) continue;
    const Mesh& mesh = *prototype.mesh;
    normals.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3d p = mesh.positions_m[a].cast<double>();
      Eigen::Vector3d n =
          (mesh.positions_m[b].cast<double>() - p).cross(mesh.positions_m[c].cast<double>() - p);
      // The vertex normals say which side is the upper one; without them the order of the vertices does.
      if (!mesh.normals.empty() &&
          n.dot((mesh.normals[a] + mesh.normals[b] + mesh.normals[c]).cast<double>()) < 0)
        n = -n;
      normals.push_back(n.normalized().cast<float>());
    }
  }
}

bool TracedScene::inside(const Box& b, const Eigen::Vector2d& by) const {
  return ((b.low.head<2>() + by).array() <= complete_high_.array()).all() &&
         ((b.high.head<2>() + by).array() >= complete_low_.array()).all();
}

void TracedScene::make_copies(const std::vector<Box>& instance_bounds) {
  constexpr double most_cells = 1000;  // across; more is a mistake in the units
  whole_copy_.assign(instances_.size(), embree::none);
  for (std::uint32_t i = 0; i < instances_.size(); ++i) {
    const Box& b = instance_bounds[i];
    if (b.empty()) continue;
    Eigen::Vector2d least = Eigen::Vector2d::Zero(), most = Eigen::Vector2d::Zero(), nearest = least;
    if (periodic_) {
      least = ((complete_low_ - b.high.head<2>()).array() / size_.array()).ceil();
      most = ((complete_high_ - b.low.head<2>()).array() / size_.array()).floor();
      nearest = (-0.5 * (b.low + b.high).head<2>().array() / size_.array()).round();
      if (!((most - least).maxCoeff() <= most_cells))
        fail(ErrorKind::bad_input, {},
             "prototype {} is more than {:.0f} times as wide as the periodic domain",
             in_quotes(prototype(i).name), most_cells);
    }
    for (double y = least.y(); y <= most.y(); ++y) {
      for (double x = least.x(); x <= most.x(); ++x) {
        Copy& copy = copies_.emplace_back();
        copy.instance = i;
        if (periodic_) copy.shift = {x * size_.x(), y * size_.y()};
        copy.whole = x == nearest.x() && y == nearest.y();
        if (copy.whole) whole_copy_[i] = static_cast<std::uint32_t>(copies_.size() - 1);
      }
    }
  }
}

std::uint64_t TracedScene::memory_bytes() const {
  std::uint64_t out = device_.memory_bytes() + top_.disc_bytes();
  for (const auto& bvh : prototype_bvh_)
    if (bvh) out += bvh->disc_bytes();
  return out;
}

std::uint64_t TracedScene::primitives(std::uint32_t prototype) const {
  const Prototype& p = prototypes_[prototype];
  return p.discs.size() + (p.mesh ? p.mesh->triangles.size() : 0);
}

// What stands once is written out. What stands many times is instanced unless it is small: its primitives
// then stay in the processor's caches, which is worth more than the step into an instance costs (HET01: twice
// the rays a second).
void TracedScene::choose_layout(const IntersectorOptions& options) {
  std::vector<std::uint64_t> uses(prototypes_.size(), 0);
  for (const Instance& instance : instances_) ++uses[instance.prototype];
  for (Copy& copy : copies_) {
    const std::uint32_t p = instances_[copy.instance].prototype;
    copy.flat =
        options.flatten_below > 0 && (uses[p] == 1 || uses[p] * primitives(p) <= options.flatten_below);
    copy.whole = copy.whole || !copy.flat;
    if (!copy.flat) instanced_ = true;
  }
}

void TracedScene::add_flat_discs(std::uint32_t number) {
  Copy& copy = copies_[number];
  const Instance& instance = instances_[copy.instance];
  const std::vector<Disc>& own = prototypes_[instance.prototype].discs;
  const auto world = [&](std::size_t k) {
    Eigen::Vector3d c = place(copy.instance, own[k].centre_m);
    c.head<2>() += copy.shift;
    return Disc{c.cast<float>(), static_cast<float>(own[k].radius_m * instance.scale),
                turn(copy.instance, own[k].normal).cast<float>()};
  };
  if (!copy.whole) {
    for (std::uint32_t k = 0; k < own.size(); ++k)
      if (inside(bounds(world(k)), Eigen::Vector2d::Zero())) copy.kept_discs.push_back(k);
  }
  const std::size_t count = copy.whole ? own.size() : copy.kept_discs.size();
  if (count == 0) return;
  std::vector<Disc> written;
  written.reserve(count);
  for (std::size_t k = 0; k < count; ++k) written.push_back(world(copy.whole ? k : copy.kept_discs[k]));
  copy.discs = &top_.add_discs(2 * number + discs, written);
}

void TracedScene::add_flat_triangles(std::uint32_t number) {
  Copy& copy = copies_[number];
  const Mesh* mesh = prototype(copy.instance).mesh.get();
  if (mesh == nullptr) return;
  std::vector<std::array<float, 3>> vertices;
  for (const Eigen::Vector3f& p : mesh->positions_m) {
    Eigen::Vector3d w = place(copy.instance, p);
    w.head<2>() += copy.shift;
    vertices.push_back({static_cast<float>(w.x()), static_cast<float>(w.y()), static_cast<float>(w.z())});
  }
  if (!copy.whole) {
    for (std::uint32_t k = 0; k < mesh->triangles.size(); ++k) {
      Box b;
      for (const std::uint32_t v : mesh->triangles[k])
        b.include(Eigen::Vector3d(vertices[v][0], vertices[v][1], vertices[v][2]));
      if (inside(b, Eigen::Vector2d::Zero())) copy.kept_triangles.push_back(k);
    }
  }
  const std::size_t count = copy.whole ? mesh->triangles.size() : copy.kept_triangles.size();
  if (count == 0) return;
  // Only the vertices that the triangles use.
  std::vector<std::uint32_t> renumbered(vertices.size(), embree::none);
  std::vector<std::array<float, 3>> used;
  std::vector<std::array<std::uint32_t, 3>> corners(count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto& own = mesh->triangles[copy.whole ? k : copy.kept_triangles[k]];
    for (std::size_t v = 0; v < 3; ++v) {
      std::uint32_t& at = renumbered[own[v]];
      if (at == embree::none) {
        at = static_cast<std::uint32_t>(used.size());
        used.push_back(vertices[own[v]]);
      }
      corners[k][v] = at;
    }
  }
  top_.add_triangles(2 * number + triangles, used.size(), count, [&](const embree::Bvh::Triangles& buffers) {
    std::copy(used.begin(), used.end(), buffers.vertex.begin());
    std::copy(corners.begin(), corners.end(), buffers.index.begin());
  });
}

std::unique_ptr<embree::Bvh> TracedScene::prototype_bvh(const Prototype& prototype) const {
  auto bvh = std::make_unique<embree::Bvh>(device_);
  if (!prototype.discs.empty()) bvh->add_discs(discs, prototype.discs);
  if (prototype.mesh && !prototype.mesh->triangles.empty()) {
    const Mesh& mesh = *prototype.mesh;
    const auto fill = [&](const embree::Bvh::Triangles& buffers) {
      for (std::size_t k = 0; k < mesh.positions_m.size(); ++k) {
        const Eigen::Vector3f& p = mesh.positions_m[k];
        buffers.vertex[k] = {p.x(), p.y(), p.z()};
      }
      std::copy(mesh.triangles.begin(), mesh.triangles.end(), buffers.index.begin());
    };
    bvh->add_triangles(triangles, mesh.positions_m.size(), mesh.triangles.size(), fill);
  }
  bvh->commit();
  return bvh;
}

void TracedScene::add_instance(std::uint32_t number) {
  const Copy& copy = copies_[number];
  const Instance& instance = instances_[copy.instance];
  auto& bvh = prototype_bvh_[instance.prototype];
  if (!bvh) bvh = prototype_bvh(prototypes_[instance.prototype]);
  const Rotation& r = rotations_[copy.instance];
  embree::Placement placement{instance.position_m, instance.scale * r.cosine, instance.scale * r.sine,
                              instance.scale};
  placement.origin.head<2>() += copy.shift;
  top_.add_instance(2 * number, *bvh, placement);
}

SurfaceId TracedScene::id(const embree::Found& found) const {
  const Copy& copy = copy_of(found);
  const std::uint32_t kind = kind_of(found);
  const std::vector<std::uint32_t>& kept = kind == discs ? copy.kept_discs : copy.kept_triangles;
  return {copy.instance, kind, copy.whole ? found.primitive : kept[found.primitive]};
}

Eigen::Vector3d TracedScene::to_world(const embree::Found& found, const Eigen::Vector3f& point) const {
  const Copy& copy = copy_of(found);
  Eigen::Vector3d out = place(copy.instance, point);
  out.head<2>() += copy.shift;
  return out;
}

Eigen::Vector3d TracedScene::place(std::uint32_t i, const Eigen::Vector3f& point) const {
  return instances_[i].position_m + instances_[i].scale * turn(i, point);
}

Eigen::Vector3d TracedScene::turn(std::uint32_t i, const Eigen::Vector3f& v) const {
  const Rotation& r = rotations_[i];
  return {r.cosine * v.x() - r.sine * v.y(), r.sine * v.x() + r.cosine * v.y(), static_cast<double>(v.z())};
}

double TracedScene::extent(const SurfaceId& id) const {
  if (id.geometry == ground) return 0;
  if (id.geometry == discs) {
    const Copy& copy = copies_[whole_copy_[id.instance]];
    return 2 * (copy.flat ? copy.discs->radius(id.primitive)
                          : instances_[id.instance].scale *
                                static_cast<double>(prototype(id.instance).discs[id.primitive].radius_m));
  }
  const Prototype& p = prototype(id.instance);
  const auto& [a, b, c] = p.mesh->triangles[id.primitive];
  const Eigen::Vector3f& from = p.mesh->positions_m[a];
  const float widest = std::max((p.mesh->positions_m[b] - from).cwiseAbs().maxCoeff(),
                                (p.mesh->positions_m[c] - from).cwiseAbs().maxCoeff());
  return instances_[id.instance].scale * 2 * static_cast<double>(widest);
}

Eigen::Vector3d TracedScene::normal(const SurfaceId& id) const {
  if (id.geometry == ground) return Eigen::Vector3d::UnitZ();
  if (id.geometry == triangles)
    return turn(id.instance, triangle_normals_[instances_[id.instance].prototype][id.primitive]);
  const Copy& copy = copies_[whole_copy_[id.instance]];
  if (!copy.flat) return turn(id.instance, prototype(id.instance).discs[id.primitive].normal);
  return copy.discs->normal(id.primitive);
}

TracedScene::Plane TracedScene::plane(const embree::Found& found) const {
  const Copy& copy = copy_of(found);
  if (kind_of(found) == discs && copy.flat)
    return {copy.discs->centre(found.primitive), copy.discs->normal(found.primitive)};
  const SurfaceId which = id(found);
  const Prototype& own = prototype(which.instance);
  const Eigen::Vector3f& point = which.geometry == discs
                                     ? own.discs[which.primitive].centre_m
                                     : own.mesh->positions_m[own.mesh->triangles[which.primitive][0]];
  return {to_world(found, point), normal(which)};
}

}  // namespace bpms
