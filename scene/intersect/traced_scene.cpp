#include "scene/intersect/traced_scene.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.h"

namespace bpms {

Box bounds(const Disc& disc) {
  // A disc of unit normal n reaches r sqrt(1 - n_i^2) along axis i.
  const Eigen::Vector3d n = disc.normal.cast<double>();
  const Eigen::Vector3d half = disc.radius_m * (1.0 - n.array().square()).max(0.0).sqrt().matrix();
  const Eigen::Vector3d c = disc.centre_m.cast<double>();
  return {c - half, c + half};
}

Box bounds(const Prototype& prototype) {
  Box out;
  for (const Disc& disc : prototype.discs) {
    const Box b = bounds(disc);
    out.include(b.low);
    out.include(b.high);
  }
  if (prototype.mesh)
    for (const Eigen::Vector3f& p : prototype.mesh->positions_m) out.include(p.cast<double>());
  return out;
}

Box bounds(const Box& prototype, const Instance& instance) {
  const double c = std::cos(instance.rotation), s = std::sin(instance.rotation);
  Box out;
  for (int corner = 0; corner < 8; ++corner) {
    const double x = corner & 1 ? prototype.high.x() : prototype.low.x();
    const double y = corner & 2 ? prototype.high.y() : prototype.low.y();
    const double z = corner & 4 ? prototype.high.z() : prototype.low.z();
    out.include(instance.position_m + instance.scale * Eigen::Vector3d(c * x - s * y, s * x + c * y, z));
  }
  return out;
}

TracedScene::TracedScene(const Scene& scene, const IntersectorOptions& options)
    : top_(device_),
      prototypes_(scene.prototypes),
      instances_(scene.instances),
      periodic_(scene.domain.periodic) {
  size_ = scene.domain.size_m;
  if (periodic_ && !(size_.minCoeff() > 0))
    throw Error(ErrorKind::bad_input, "a periodic domain needs a size (domain.size_m)");
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
          n.dot((mesh.normals[a] + mesh.normals[b] + mesh.normals[c]).cast<double>()) < 0) {
        n = -n;
      }
      normals.push_back(n.normalized().cast<float>());
    }
  }
  std::vector<Box> prototype_bounds, instance_bounds;
  for (const Prototype& prototype : prototypes_) prototype_bounds.push_back(bounds(prototype));
  for (const Instance& instance : instances_) {
    rotations_.push_back({std::cos(instance.rotation), std::sin(instance.rotation)});
    const Box& own = prototype_bounds[instance.prototype];
    instance_bounds.push_back(own.empty() ? Box{} : bounds(own, instance));
    if (own.empty()) continue;
    box_.include(instance_bounds.back().low);
    box_.include(instance_bounds.back().high);
  }
  if (periodic_) {
    margin_ = options.margin_m >= 0 ? options.margin_m : 0;
    // A hair more, so that no rounding opens a gap where a ray changes sides.
    const double slack = 1e-5 * (size_.maxCoeff() + margin_);
    complete_low_ = (-0.5 * size_).array() - margin_ - slack;
    complete_high_ = (0.5 * size_).array() + margin_ + slack;
    box_.low.head<2>() = -0.5 * size_;
    box_.high.head<2>() = 0.5 * size_;
  }

  const std::vector<Copy> all = copies_over_cell(instance_bounds);
  std::uint64_t primitives = 0;
  for (const Copy& copy : all) {
    const Prototype& prototype = prototypes_[instances_[copy.instance].prototype];
    primitives += prototype.discs.size() + (prototype.mesh ? prototype.mesh->triangles.size() : 0);
  }
  if (primitives <= options.flatten_limit) {
    add_flat(all);
  } else {
    add_instanced(all);
  }
  top_.commit();
}

bool TracedScene::inside(const Box& b, const Eigen::Vector2d& by) const {
  if (!periodic_) return true;
  return ((b.low.head<2>() + by).array() <= complete_high_.array()).all() &&
         ((b.high.head<2>() + by).array() >= complete_low_.array()).all();
}

std::vector<TracedScene::Copy> TracedScene::copies_over_cell(const std::vector<Box>& instance_bounds) const {
  constexpr double most_cells = 1000;  // across; more is a mistake in the units
  std::vector<Copy> out;
  for (std::uint32_t i = 0; i < instances_.size(); ++i) {
    const Box& b = instance_bounds[i];
    if (b.empty()) continue;
    if (!periodic_) {
      out.push_back({i, 0, 0});
      continue;
    }
    const Eigen::Vector2d least = ((complete_low_ - b.high.head<2>()).array() / size_.array()).ceil();
    const Eigen::Vector2d most = ((complete_high_ - b.low.head<2>()).array() / size_.array()).floor();
    if ((most - least).maxCoeff() > most_cells || least.cwiseAbs().maxCoeff() > 3e4)
      fail(ErrorKind::bad_input, {}, "prototype {} is more than {:.0f} times as wide as the periodic domain",
           in_quotes(prototypes_[instances_[i].prototype].name), most_cells);
    for (int y = static_cast<int>(least.y()); y <= static_cast<int>(most.y()); ++y)
      for (int x = static_cast<int>(least.x()); x <= static_cast<int>(most.x()); ++x)
        out.push_back({i, x, y});
  }
  return out;
}

void TracedScene::add_flat(const std::vector<Copy>& copies) {
  add_flat_discs(copies);
  add_flat_triangles(copies);
}

void TracedScene::add_flat_discs(const std::vector<Copy>& copies) {
  for (const Copy& copy : copies) {
    const Instance& instance = instances_[copy.instance];
    const std::vector<Disc>& own = prototypes_[instance.prototype].discs;
    for (std::uint32_t k = 0; k < own.size(); ++k) {
      if (periodic_) {
        const Disc world{to_world(copy.instance, own[k].centre_m).cast<float>(),
                         static_cast<float>(own[k].radius_m * instance.scale),
                         turn(copy.instance, own[k].normal).cast<float>()};
        if (!inside(bounds(world), shift(copy.shift_x, copy.shift_y))) continue;
      }
      flat_discs_.push_back({copy.instance, k, static_cast<std::int16_t>(copy.shift_x),
                             static_cast<std::int16_t>(copy.shift_y)});
    }
  }
  if (flat_discs_.empty()) return;
  top_.add_discs(discs, flat_discs_.size(), [&](const embree::Bvh::Discs& buffers) {
    for (std::size_t k = 0; k < flat_discs_.size(); ++k) {
      const Flat& flat = flat_discs_[k];
      const Instance& instance = instances_[flat.instance];
      const Disc& disc = prototypes_[instance.prototype].discs[flat.primitive];
      Eigen::Vector3d c = to_world(flat.instance, disc.centre_m);
      c.head<2>() += shift(flat.shift_x, flat.shift_y);
      const Eigen::Vector3f n = turn(flat.instance, disc.normal).cast<float>();
      buffers.centre_radius[k] = {static_cast<float>(c.x()), static_cast<float>(c.y()),
                                  static_cast<float>(c.z()),
                                  static_cast<float>(disc.radius_m * instance.scale)};
      buffers.normal[k] = {n.x(), n.y(), n.z()};
    }
  });
}

void TracedScene::add_flat_triangles(const std::vector<Copy>& copies) {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangle_list;
  for (const Copy& copy : copies) {
    const Mesh* mesh = prototypes_[instances_[copy.instance].prototype].mesh.get();
    if (mesh == nullptr) continue;
    std::vector<std::uint32_t> number(mesh->positions_m.size(), embree::none);
    for (std::uint32_t k = 0; k < mesh->triangles.size(); ++k) {
      const auto& corners = mesh->triangles[k];
      if (periodic_) {
        Box b;
        for (const std::uint32_t v : corners) b.include(to_world(copy.instance, mesh->positions_m[v]));
        if (!inside(b, shift(copy.shift_x, copy.shift_y))) continue;
      }
      std::array<std::uint32_t, 3>& flat = triangle_list.emplace_back();
      for (std::size_t v = 0; v < 3; ++v) {
        std::uint32_t& at = number[corners[v]];
        if (at == embree::none) {
          at = static_cast<std::uint32_t>(vertices.size());
          Eigen::Vector3d p = to_world(copy.instance, mesh->positions_m[corners[v]]);
          p.head<2>() += shift(copy.shift_x, copy.shift_y);
          vertices.push_back(
              {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
        }
        flat[v] = at;
      }
      flat_triangles_.push_back({copy.instance, k, static_cast<std::int16_t>(copy.shift_x),
                                 static_cast<std::int16_t>(copy.shift_y)});
    }
  }
  if (triangle_list.empty()) return;
  top_.add_triangles(triangles, vertices.size(), triangle_list.size(),
                     [&](const embree::Bvh::Triangles& buffers) {
                       std::copy(vertices.begin(), vertices.end(), buffers.vertex.begin());
                       std::copy(triangle_list.begin(), triangle_list.end(), buffers.index.begin());
                     });
}

void TracedScene::add_instanced(const std::vector<Copy>& copies) {
  for (const Prototype& prototype : prototypes_) {
    auto& bvh = *prototype_bvh_.emplace_back(std::make_unique<embree::Bvh>(device_));
    if (!prototype.discs.empty()) {
      bvh.add_discs(discs, prototype.discs.size(), [&](const embree::Bvh::Discs& buffers) {
        for (std::size_t k = 0; k < prototype.discs.size(); ++k) {
          const Disc& d = prototype.discs[k];
          buffers.centre_radius[k] = {d.centre_m.x(), d.centre_m.y(), d.centre_m.z(), d.radius_m};
          buffers.normal[k] = {d.normal.x(), d.normal.y(), d.normal.z()};
        }
      });
    }
    if (prototype.mesh && !prototype.mesh->triangles.empty()) {
      const Mesh& mesh = *prototype.mesh;
      bvh.add_triangles(
          triangles, mesh.positions_m.size(), mesh.triangles.size(),
          [&](const embree::Bvh::Triangles& buffers) {
            for (std::size_t k = 0; k < mesh.positions_m.size(); ++k)
              buffers.vertex[k] = {mesh.positions_m[k].x(), mesh.positions_m[k].y(), mesh.positions_m[k].z()};
            std::copy(mesh.triangles.begin(), mesh.triangles.end(), buffers.index.begin());
          });
    }
    bvh.commit();
  }
  copies_ = copies;
  for (std::uint32_t k = 0; k < copies_.size(); ++k) {
    const Copy& copy = copies_[k];
    const Instance& instance = instances_[copy.instance];
    const Rotation& r = rotations_[copy.instance];
    embree::Placement placement{instance.position_m, instance.scale * r.cosine, instance.scale * r.sine,
                                instance.scale};
    placement.origin.head<2>() += shift(copy.shift_x, copy.shift_y);
    top_.add_instance(first_instance + k, *prototype_bvh_[instance.prototype], placement);
  }
}

TracedScene::Element TracedScene::identify(const embree::Found& found) const {
  if (found.instance != embree::none) {
    const Copy& copy = copies_[found.instance - first_instance];
    return {{copy.instance, found.geometry, found.primitive}, shift(copy.shift_x, copy.shift_y)};
  }
  const Flat& flat = (found.geometry == discs ? flat_discs_ : flat_triangles_)[found.primitive];
  return {{flat.instance, found.geometry, flat.primitive}, shift(flat.shift_x, flat.shift_y)};
}

Eigen::Vector3d TracedScene::to_world(std::uint32_t i, const Eigen::Vector3f& point) const {
  const Instance& instance = instances_[i];
  return instance.position_m + instance.scale * turn(i, point);
}

Eigen::Vector3d TracedScene::turn(std::uint32_t i, const Eigen::Vector3f& v) const {
  const Rotation& r = rotations_[i];
  return {r.cosine * v.x() - r.sine * v.y(), r.sine * v.x() + r.cosine * v.y(), static_cast<double>(v.z())};
}

Eigen::Vector3d TracedScene::normal(const SurfaceId& id) const {
  if (id.geometry == ground) return Eigen::Vector3d::UnitZ();
  if (id.geometry == discs) return turn(id.instance, prototype_of(id).discs[id.primitive].normal);
  return turn(id.instance, triangle_normals_[instances_[id.instance].prototype][id.primitive]);
}

TracedScene::Plane TracedScene::plane(const SurfaceId& id) const {
  const Prototype& prototype = prototype_of(id);
  const Eigen::Vector3f& point =
      id.geometry == discs ? prototype.discs[id.primitive].centre_m
                           : prototype.mesh->positions_m[prototype.mesh->triangles[id.primitive][0]];
  return {to_world(id.instance, point), normal(id)};
}

}  // namespace bpms
