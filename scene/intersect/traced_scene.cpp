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
  if (scene.ground && scene.ground->terrain) add_terrain(*scene.ground->terrain, scene.ground->material);
  std::vector<Box> prototype_bounds, instance_bounds;
  for (const Prototype& prototype : prototypes_) prototype_bounds.push_back(bounds(prototype));
  for (const Instance& instance : instances_) {
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
  estimate(options);
  sort_discs();
  make_triangle_normals();
  prototype_bvh_.resize(prototypes_.size());
  for (std::uint32_t k = 0; k < copies_.size(); ++k) {
    if (copies_[k].written != embree::none) {
      add_flat_discs(k);
      add_flat_triangles(k);
      add_flat_shapes(k);
    } else {
      add_instance(k);
    }
  }
  top_.commit();
}

void TracedScene::add_terrain(const Terrain& terrain, std::uint32_t material) {
  Prototype prototype;
  prototype.name = "terrain";
  prototype.mesh = terrain.mesh;
  prototype.material_of_organ = {material};
  terrain_ = static_cast<std::uint32_t>(instances_.size());
  instances_.emplace_back().prototype = static_cast<std::uint32_t>(prototypes_.size());
  prototypes_.push_back(std::move(prototype));
}

void TracedScene::sort_discs() {
  for (Prototype& prototype : prototypes_) {
    std::vector<Eigen::Vector3f> centres;
    for (const Disc& disc : prototype.discs) centres.push_back(disc.centre_m);
    std::vector<Disc> sorted;
    std::vector<std::uint32_t> materials;
    sorted.reserve(centres.size());
    for (const std::uint32_t k : cluster_order(centres, embree::DiscClusters::wide)) {
      sorted.push_back(prototype.discs[k]);
      if (!prototype.material_of_disc.empty()) materials.push_back(prototype.material_of_disc[k]);
    }
    prototype.discs = std::move(sorted);
    prototype.material_of_disc = std::move(materials);
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

bool TracedScene::inside(const Box& b) const {
  return (b.low.head<2>().array() <= complete_high_.array()).all() &&
         (b.high.head<2>().array() >= complete_low_.array()).all();
}

void TracedScene::make_copies(const std::vector<Box>& instance_bounds) {
  constexpr double most_cells = 1000;  // across; more is a mistake in the units
  whole_copy_.assign(instances_.size(), embree::none);
  copies_.reserve(instances_.size());
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
      constexpr double farthest_cells = 32'000;
      if (!(std::max(least.cwiseAbs().maxCoeff(), most.cwiseAbs().maxCoeff()) <= farthest_cells))
        fail(ErrorKind::bad_input, {},
             "an instance of prototype {} stands more than {:.0f} periodic domains away from the origin",
             in_quotes(prototype(i).name), farthest_cells);
    }
    for (double y = least.y(); y <= most.y(); ++y) {
      for (double x = least.x(); x <= most.x(); ++x) {
        if (x == nearest.x() && y == nearest.y()) whole_copy_[i] = static_cast<std::uint32_t>(copies_.size());
        copies_.push_back({i, static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), embree::none});
      }
    }
  }
  constexpr std::size_t most_copies = 1u << 29;  // as many as their numbers can name
  if (copies_.size() > most_copies)
    fail(ErrorKind::missing_resource, {}, "{} instances, more than {} cannot be traced", copies_.size(),
         most_copies);
}

std::uint64_t TracedScene::primitives(const Prototype& p) {
  return p.discs.size() + (p.mesh ? p.mesh->triangles.size() : 0) + p.shapes.size();
}

// What stands once is written out. What stands many times is instanced unless it is small: its primitives
// then stay in the processor's caches, which is worth more than the step into an instance costs (HET01: twice
// the rays a second).
void TracedScene::choose_layout(const IntersectorOptions& options) {
  std::vector<std::uint64_t> uses(prototypes_.size(), 0);
  for (const Instance& instance : instances_) ++uses[instance.prototype];
  for (std::uint32_t k = 0; k < copies_.size(); ++k) {
    Copy& copy = copies_[k];
    const std::uint32_t p = instances_[copy.instance].prototype;
    if (options.flatten_below > 0 &&
        (uses[p] == 1 || uses[p] * primitives(prototypes_[p]) <= options.flatten_below)) {
      copy.written = static_cast<std::uint32_t>(written_.size());
      written_.emplace_back().whole = whole_copy_[copy.instance] == k;
    } else {
      instanced_ = true;
    }
  }
}

std::uint32_t TracedScene::plant(std::uint32_t instance) const {
  if (instance >= instances_.size() || is_terrain(instance)) return no_plant;
  const std::uint32_t plant = instances_[instance].plant;
  return plant != no_plant ? plant : instance;
}

SurfaceId TracedScene::id(const embree::Found& found) const {
  const Copy& copy = copy_of(found);
  const std::uint32_t kind = kind_of(found);
  const Written* written = written_of(copy);
  if (written == nullptr || written->whole) return {copy.instance, kind, found.primitive};
  switch (kind) {
    case discs:
      return {copy.instance, kind, written->kept_discs[found.primitive]};
    case triangles:
      return {copy.instance, kind, written->kept_triangles[found.primitive]};
    default:
      return {copy.instance, kind, 4 * written->kept_shapes[found.primitive / 4] + found.primitive % 4};
  }
}

Eigen::Vector3d TracedScene::to_world(const embree::Found& found, const Eigen::Vector3d& point) const {
  const Copy& copy = copy_of(found);
  return place(copy.instance, point) + shift(copy);
}

double TracedScene::extent(const SurfaceId& id) const {
  if (!is_primitive(id)) return 0;
  const double scale = instances_[id.instance].scale;
  if (id.geometry == discs) {
    const Written* written = written_of(copies_[whole_copy_[id.instance]]);
    return 2 * (written != nullptr
                    ? written->discs->radius(id.primitive)
                    : scale * static_cast<double>(prototype(id.instance).discs[id.primitive].radius_m));
  }
  const Prototype& p = prototype(id.instance);
  if (id.geometry == shapes) {
    const Shape& shape = p.shapes[id.primitive / 4];
    const Eigen::Vector3d s = shape.size_m.cast<double>();
    return scale *
           (shape.kind == Shape::Kind::ellipsoid ? 2 * s.maxCoeff() : s[2] + 2 * std::max(s[0], s[1]));
  }
  const auto& [a, b, c] = p.mesh->triangles[id.primitive];
  const Eigen::Vector3f& from = p.mesh->positions_m[a];
  const float widest = std::max((p.mesh->positions_m[b] - from).cwiseAbs().maxCoeff(),
                                (p.mesh->positions_m[c] - from).cwiseAbs().maxCoeff());
  return scale * 2 * static_cast<double>(widest);
}

double TracedScene::thinnest(const SurfaceId& id) const {
  return scale(id.instance) * shape_thinnest_m(prototype(id.instance).shapes[id.primitive / 4]);
}

Eigen::Vector3d TracedScene::normal(const SurfaceId& id, const Eigen::Vector3d& position) const {
  if (id.geometry == discs) {
    const Written* written = written_of(copies_[whole_copy_[id.instance]]);
    if (written != nullptr) return written->discs->normal(id.primitive);
    return turn(id.instance, prototype(id.instance).discs[id.primitive].normal.cast<double>());
  }
  if (id.geometry == triangles)
    return turn(id.instance,
                triangle_normals_[instances_[id.instance].prototype][id.primitive].cast<double>());
  if (id.geometry != shapes) return Eigen::Vector3d::UnitZ();
  // The image of the instance that is nearest to the point.
  const Instance& instance = instances_[id.instance];
  const Shape& shape = prototype(id.instance).shapes[id.primitive / 4];
  Eigen::Vector3d offset = position - place(id.instance, shape.centre_m.cast<double>());
  if (periodic_)
    offset.head<2>().array() -= size_.array() * (offset.head<2>().array() / size_.array()).round();
  const Eigen::Vector3d own = shape.centre_m.cast<double>() + instance.rotation.back(offset) / instance.scale;
  return turn(id.instance, shape_normal(shape, static_cast<int>(id.primitive % 4), own));
}

TracedScene::Plane TracedScene::disc(const embree::Found& found, const SurfaceId& id, double& extent) const {
  const Copy& copy = copy_of(found);
  if (const Written* written = written_of(copy)) {
    extent = 2 * written->discs->radius(found.primitive);
    return {written->discs->centre(found.primitive), written->discs->normal(found.primitive)};
  }
  const Instance& instance = instances_[copy.instance];
  const Disc& own = prototypes_[instance.prototype].discs[id.primitive];
  extent = 2 * instance.scale * static_cast<double>(own.radius_m);
  return {to_world(found, own.centre_m.cast<double>()), instance.rotation * own.normal.cast<double>()};
}

TracedScene::Plane TracedScene::plane(const embree::Found& found) const {
  const Copy& copy = copy_of(found);
  const std::uint32_t kind = kind_of(found);
  if (const Written* written = written_of(copy); kind == discs && written != nullptr)
    return {written->discs->centre(found.primitive), written->discs->normal(found.primitive)};
  const SurfaceId which = id(found);
  const Prototype& own = prototype(which.instance);
  const Eigen::Vector3f& point = which.geometry == discs
                                     ? own.discs[which.primitive].centre_m
                                     : own.mesh->positions_m[own.mesh->triangles[which.primitive][0]];
  const Eigen::Vector3d world = to_world(found, point.cast<double>());
  return {world, normal(which, world)};
}

const Shape& TracedScene::shape_of(const Copy& copy, std::uint32_t index) const {
  const Written* written = written_of(copy);
  return written != nullptr ? (*written->shapes)[index] : prototype(copy.instance).shapes[index];
}

ShapePoint TracedScene::shape_at(const embree::Found& found) const {
  const Copy& copy = copy_of(found);
  const auto part = static_cast<int>(found.primitive % 4);
  ShapePoint out = shape_point(shape_of(copy, found.primitive / 4), part,
                               Eigen::Vector3f(found.at[0], found.at[1], found.at[2]));
  if (copy.written != embree::none) return out;
  const double by = scale(copy.instance);
  out.position = to_world(found, out.position);
  out.normal = turn(copy.instance, out.normal);
  out.dp_du = by * turn(copy.instance, out.dp_du);
  out.dp_dv = by * turn(copy.instance, out.dp_dv);
  return out;
}

double TracedScene::shape_offset_of(const embree::Found& found, int part,
                                    const Eigen::Vector3d& position) const {
  const Copy& copy = copy_of(found);
  const Shape& shape = shape_of(copy, found.primitive / 4);
  if (copy.written != embree::none) return shape_offset(shape, part, position);
  const Instance& instance = instances_[copy.instance];
  const Eigen::Vector3d own =
      instance.rotation.back(position - instance.position_m - shift(copy)) / instance.scale;
  return instance.scale * shape_offset(shape, part, own);
}

bool TracedScene::inside_closed_shape(const Eigen::Vector3d& point) const {
  for (const Copy& copy : copies_) {
    const Prototype& own = prototype(copy.instance);
    if (own.shapes.empty()) continue;
    const Instance& instance = instances_[copy.instance];
    const Eigen::Vector3d at =
        instance.rotation.back(point - instance.position_m - shift(copy)) / instance.scale;
    for (const Shape& shape : own.shapes)
      if (shape_contains(shape, at)) return true;
  }
  return false;
}

std::uint64_t TracedScene::memory_bytes() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::uint64_t out = device_.memory_bytes() + top_.own_bytes() + bytes(instances_) + bytes(copies_) +
                      bytes(written_) + bytes(owners_) + bytes(whole_copy_);
  for (const auto& bvh : prototype_bvh_)
    if (bvh) out += bvh->own_bytes();
  for (const Prototype& p : prototypes_) out += bytes(p.discs) + bytes(p.material_of_disc) + bytes(p.shapes);
  for (const auto& normals : triangle_normals_) out += bytes(normals);
  for (const Written& w : written_)
    out += bytes(w.kept_discs) + bytes(w.kept_triangles) + bytes(w.kept_shapes);
  return out;
}

}  // namespace bpms
