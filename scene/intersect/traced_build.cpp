// How copies of instances come into the hierarchy: written out, or as Embree's instances; and what that
// takes.
#include <algorithm>

#include "core/error.h"
#include "scene/intersect/traced_scene.h"

namespace bpms {
namespace {

// Bytes as measured with Embree 3.13 (bench_instances prints them again): a primitive with its share of the
// hierarchy and of what is kept beside it, and an instance.
constexpr std::uint64_t bytes_of_disc = 90, bytes_of_triangle = 115, bytes_of_shape = 230,
                        bytes_of_instance = 330;

std::uint64_t bytes_of(const Prototype& p) {
  return p.discs.size() * bytes_of_disc + (p.mesh ? p.mesh->triangles.size() * bytes_of_triangle : 0) +
         p.shapes.size() * bytes_of_shape;
}

double gib(std::uint64_t bytes) {
  return static_cast<double>(bytes) / (1u << 30);
}

}  // namespace

void TracedScene::estimate(const IntersectorOptions& options) {
  // Of a written copy that only completes the cell, few primitives are kept: it is not counted.
  std::vector<std::uint64_t> instanced(prototypes_.size(), 0), whole(instanced), bytes(instanced);
  for (std::uint32_t k = 0; k < copies_.size(); ++k) {
    const Copy& copy = copies_[k];
    if (copy.written == embree::none) ++instanced[instances_[copy.instance].prototype];
    if (copy.written != embree::none && written_[copy.written].whole)
      ++whole[instances_[copy.instance].prototype];
  }
  for (std::size_t p = 0; p < prototypes_.size(); ++p) {
    bytes[p] = whole[p] * bytes_of(prototypes_[p]) + instanced[p] * bytes_of_instance +
               (instanced[p] > 0 ? bytes_of(prototypes_[p]) : 0);
    estimated_bytes_ += bytes[p];
  }
  if (options.most_bytes == 0 || estimated_bytes_ <= options.most_bytes) return;
  const auto most = static_cast<std::size_t>(std::max_element(bytes.begin(), bytes.end()) - bytes.begin());
  fail(ErrorKind::missing_resource, {},
       "tracing this scene needs some {:.3g} GiB, the limit is {:.3g} GiB; most of it goes to prototype {}: "
       "{:.3g} GiB for {} primitives, {} of them written out, {} instances",
       gib(estimated_bytes_), gib(options.most_bytes), in_quotes(prototypes_[most].name), gib(bytes[most]),
       primitives(prototypes_[most]), whole[most] * primitives(prototypes_[most]), instanced[most]);
}

std::uint32_t TracedScene::new_owner(std::uint32_t copy, std::uint32_t kind) {
  owners_.push_back(4 * copy + kind);
  return static_cast<std::uint32_t>(owners_.size() - 1);
}

void TracedScene::add_flat_discs(std::uint32_t number) {
  const Copy& copy = copies_[number];
  Written& written = written_[copy.written];
  const Instance& instance = instances_[copy.instance];
  const std::vector<Disc>& own = prototypes_[instance.prototype].discs;
  const Eigen::Vector3d by = shift(copy);
  const auto world = [&](std::size_t k) {
    const Eigen::Vector3d c = place(copy.instance, own[k].centre_m.cast<double>()) + by;
    return Disc{c.cast<float>(), static_cast<float>(own[k].radius_m * instance.scale),
                turn(copy.instance, own[k].normal.cast<double>()).cast<float>()};
  };
  if (!written.whole) {
    for (std::uint32_t k = 0; k < own.size(); ++k)
      if (inside(bounds(world(k)))) written.kept_discs.push_back(k);
  }
  const std::size_t count = written.whole ? own.size() : written.kept_discs.size();
  if (count == 0) return;
  std::vector<Disc> out;
  out.reserve(count);
  for (std::size_t k = 0; k < count; ++k) out.push_back(world(written.whole ? k : written.kept_discs[k]));
  written.discs = &top_.add_discs(new_owner(number, discs), out);
}

void TracedScene::add_flat_shapes(std::uint32_t number) {
  const Copy& copy = copies_[number];
  Written& written = written_[copy.written];
  const Instance& instance = instances_[copy.instance];
  const Eigen::Vector3d by = shift(copy);
  std::vector<Shape> out;
  const std::vector<Shape>& own = prototypes_[instance.prototype].shapes;
  for (std::uint32_t k = 0; k < own.size(); ++k) {
    Shape shape = own[k];
    shape.centre_m = (place(copy.instance, own[k].centre_m.cast<double>()) + by).cast<float>();
    shape.rotation = Rotation(instance.rotation.quaternion() * own[k].rotation.quaternion());
    shape.size_m = (instance.scale * own[k].size_m.cast<double>()).cast<float>();
    if (!written.whole) {
      if (!inside(bounds(shape))) continue;
      written.kept_shapes.push_back(k);
    }
    out.push_back(shape);
  }
  if (!out.empty()) written.shapes = &top_.add_shapes(new_owner(number, shapes), std::move(out));
}

void TracedScene::add_flat_triangles(std::uint32_t number) {
  const Copy& copy = copies_[number];
  Written& written = written_[copy.written];
  const Mesh* mesh = prototype(copy.instance).mesh.get();
  if (mesh == nullptr) return;
  const Eigen::Vector3d by = shift(copy);
  std::vector<std::array<float, 3>> vertices;
  vertices.reserve(mesh->positions_m.size());
  for (const Eigen::Vector3f& p : mesh->positions_m) {
    const Eigen::Vector3d w = place(copy.instance, p.cast<double>()) + by;
    vertices.push_back({static_cast<float>(w.x()), static_cast<float>(w.y()), static_cast<float>(w.z())});
  }
  if (!written.whole) {
    for (std::uint32_t k = 0; k < mesh->triangles.size(); ++k) {
      Box b;
      for (const std::uint32_t v : mesh->triangles[k])
        b.include(Eigen::Vector3d(vertices[v][0], vertices[v][1], vertices[v][2]));
      if (inside(b)) written.kept_triangles.push_back(k);
    }
  }
  const std::size_t count = written.whole ? mesh->triangles.size() : written.kept_triangles.size();
  if (count == 0) return;
  // Only the vertices that the triangles use.
  std::vector<std::uint32_t> renumbered(vertices.size(), embree::none);
  std::vector<std::array<float, 3>> used;
  std::vector<std::array<std::uint32_t, 3>> corners(count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto& own = mesh->triangles[written.whole ? k : written.kept_triangles[k]];
    for (std::size_t v = 0; v < 3; ++v) {
      std::uint32_t& at = renumbered[own[v]];
      if (at == embree::none) {
        at = static_cast<std::uint32_t>(used.size());
        used.push_back(vertices[own[v]]);
      }
      corners[k][v] = at;
    }
  }
  top_.add_triangles(new_owner(number, triangles), used.size(), count,
                     [&](const embree::Bvh::Triangles& buffers) {
                       std::copy(used.begin(), used.end(), buffers.vertex.begin());
                       std::copy(corners.begin(), corners.end(), buffers.index.begin());
                     });
}

std::unique_ptr<embree::Bvh> TracedScene::prototype_bvh(const Prototype& prototype) const {
  auto bvh = std::make_unique<embree::Bvh>(device_);
  if (!prototype.discs.empty()) bvh->add_discs(discs, prototype.discs);
  if (!prototype.shapes.empty()) bvh->add_shapes(shapes, prototype.shapes);
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
  top_.add_instance(new_owner(number, discs), *bvh,
                    {instance.position_m + shift(copy), instance.scale * instance.rotation.matrix()});
}

}  // namespace bpms
