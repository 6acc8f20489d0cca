#include "scene/intersect/intersector.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/intersect/parallel_rays.h"
#include "scene/intersect/traced_scene.h"

namespace bpms {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Float coordinates of size x are off by up to 6e-8 x; a start that is lifted off its surface by a few times
// that lies on the side it should. Embree's transform into an instance's frame rounds some four times more.
constexpr double lift_flat = 6e-7;
constexpr double lift_instanced = 2e-6;
// Where the ray runs in the surface's plane to this sine, its hits on that very surface are looked at one by
// one.
constexpr double grazing = 1e-5;

}  // namespace

struct Intersector::Impl {
  explicit Impl(const Scene& scene, const IntersectorOptions& options);

  // A ray on its way: its place in the current piece, and how long the pieces before were.
  struct Way {
    Eigen::Vector3d origin;
    Eigen::Vector3d direction;
    double far;     // from the first origin
    double before;  // length of the pieces before
    double lift;
    SurfaceId from;
  };
  enum class Met { nothing, geometry, ground };
  struct Found {
    embree::Found what;
    Way way;  // the piece it was met on
  };

  Way start(const Ray& ray) const;
  void into_cell(Eigen::Vector3d& point) const;
  template <bool any>
  Escape trace(const Ray& ray, Found& found, double& ground_distance) const;
  template <bool any>
  bool piece(const Way& way, double length, embree::Found& found) const;
  bool is_start(const Way& way, const embree::Found& found) const;
  void describe(const Found& found, Hit& hit) const;
  void describe_ground(const Way& way, double distance, Hit& hit) const;

  TracedScene traced;
  std::optional<Ground> ground;
  bool periodic;
  int max_wraps;
  Eigen::Vector2d size, low, high;  // the cell
  double top, bottom, slack;
  double lift;
};

Intersector::Impl::Impl(const Scene& scene, const IntersectorOptions& options)
    : traced(scene, options),
      ground(scene.ground),
      periodic(scene.domain.periodic),
      max_wraps(options.max_wraps) {
  const Box& box = traced.box();
  size = scene.domain.size_m;
  low = box.low.head<2>();
  high = box.high.head<2>();
  top = box.low.z() > box.high.z() ? -infinity : box.high.z();
  bottom = box.low.z() > box.high.z() ? infinity : box.low.z();
  if (ground) {
    top = std::max(top, ground->height_m);
    bottom = std::min(bottom, ground->height_m);
  }
  if (!(top >= bottom)) top = bottom = 0;
  if (!periodic && !(high.x() >= low.x())) low = high = Eigen::Vector2d::Zero();
  if (!periodic && size.minCoeff() > 0) low = -0.5 * size, high = 0.5 * size;
  // Never nothing: a ray brought down to a bare plane at height 0 must not round to below it.
  slack = 1e-5 * std::max({std::abs(top), std::abs(bottom), top - bottom, 1e-4});
  lift = traced.instanced() ? lift_instanced : lift_flat;
}

void Intersector::Impl::into_cell(Eigen::Vector3d& point) const {
  for (int axis = 0; axis < 2; ++axis) {
    if (point[axis] >= low[axis] && point[axis] < high[axis]) continue;
    point[axis] -= size[axis] * std::floor((point[axis] - low[axis]) / size[axis]);
  }
}

Intersector::Impl::Way Intersector::Impl::start(const Ray& ray) const {
  Way way{ray.origin.cast<double>(), ray.direction.cast<double>(), ray.far, 0, 0, ray.from};
  if (periodic) into_cell(way.origin);
  way.lift = lift * (way.origin.cwiseAbs().maxCoeff() + 1e-3);
  if (way.from.geometry < TracedScene::ground) {
    // A point of a wide triangle near the scene's origin is as inexact as the triangle's far corners.
    const bool known = ray.from_extent >= 0;
    way.lift += lift * (known ? static_cast<double>(ray.from_extent) : traced.extent(way.from));
    const Eigen::Vector3d n = known ? ray.from_normal.cast<double>().eval() : traced.normal(way.from);
    way.origin += (n.dot(way.direction) < 0 ? -way.lift : way.lift) * n;
  }
  return way;
}

// Is this the very element that the ray started on (and not a shifted copy of it)?
bool Intersector::Impl::is_start(const Way& way, const embree::Found& found) const {
  const SurfaceId id = traced.id(found);
  if (id.instance != way.from.instance || id.geometry != way.from.geometry ||
      id.primitive != way.from.primitive)
    return false;
  const TracedScene::Plane plane = traced.plane(found);
  const Eigen::Vector3d start = way.origin - way.before * way.direction;
  return std::abs((start - plane.point).dot(plane.normal)) <= 4 * way.lift;
}

// Is anything met between the way's origin and `length`? For any = true, `found` may stay as it is.
template <bool any>
bool Intersector::Impl::piece(const Way& way, double length, embree::Found& found) const {
  embree::Segment segment{way.origin.cast<float>(), 0, way.direction.cast<float>(),
                          static_cast<float>(length)};
  const bool may_meet_start = way.from.geometry < TracedScene::ground;
  if constexpr (any) {
    if (!may_meet_start || std::abs(traced.normal(way.from).dot(way.direction)) > grazing)
      return traced.bvh().occluded(segment);
  }
  while (traced.bvh().intersect(segment, found)) {
    if (!may_meet_start || !is_start(way, found)) return true;
    segment.near = std::nextafter(found.distance, std::numeric_limits<float>::infinity());
    if (segment.near > segment.far) return false;
  }
  return false;
}

template <bool any>
Escape Intersector::Impl::trace(const Ray& ray, Found& found, double& ground_distance) const {
  embree::prepare_thread();
  Way& way = found.way;
  way = start(ray);
  const double dz = way.direction.z();
  const auto advance = [&](double length) {
    way.origin += length * way.direction;
    way.before += length;
  };
  // From outside the slab that holds the scene: up to it at once.
  if (way.origin.z() > top + slack) {
    if (dz >= 0) return Escape::top;
    advance((top + slack - way.origin.z()) / dz);
    if (periodic) into_cell(way.origin);
  } else if (way.origin.z() < bottom - slack) {
    if (dz <= 0) return Escape::bottom;
    advance((bottom - slack - way.origin.z()) / dz);
    if (periodic) into_cell(way.origin);
  }
  const bool may_meet_ground = ground && way.from.geometry != TracedScene::ground &&
                               (way.origin.z() >= ground->height_m ? dz < 0 : dz > 0);
  for (int wraps = 0;; ++wraps) {
    const double to_far = way.far - way.before;
    if (to_far < 0) return dz < 0 ? Escape::bottom : Escape::top;
    const double to_ground = may_meet_ground ? (ground->height_m - way.origin.z()) / dz : infinity;
    const double to_edge = dz > 0   ? (top + slack - way.origin.z()) / dz
                           : dz < 0 ? (bottom - slack - way.origin.z()) / dz
                                    : infinity;
    const double last = std::min({to_far, to_ground, to_edge});
    double to_side = infinity;
    int side = 0;
    if (periodic) {
      for (int axis = 0; axis < 2; ++axis) {
        const double d = way.direction[axis];
        if (d == 0) continue;
        const double t = ((d > 0 ? high[axis] : low[axis]) - way.origin[axis]) / d;
        if (t < to_side) to_side = t, side = axis;
      }
    }
    const bool ends = last <= to_side;
    // A piece that ends at a side goes a hair beyond it, and the next one starts a hair before.
    if (piece<any>(way, ends ? last : to_side + way.lift, found.what)) return Escape::hit;
    if (ends) {
      if (last == to_ground && to_ground <= to_far) {
        ground_distance = to_ground;
        return Escape::hit;
      }
      return dz < 0 ? Escape::bottom : Escape::top;
    }
    if (wraps >= max_wraps) return Escape::wrap_limit;
    advance(std::max(0.0, to_side - way.lift));
    way.origin[side] -= std::copysign(size[side], way.direction[side]);
  }
}

void Intersector::Impl::describe(const Found& found, Hit& hit) const {
  const auto& [what, way] = found;
  const SurfaceId id = traced.id(what);
  const Prototype& prototype = traced.prototype(id.instance);
  hit.id = id;
  hit.distance = static_cast<float>(way.before + what.distance);
  hit.uv = {what.u, what.v};
  hit.ground = false;
  const auto [point, normal] = traced.plane(what);
  hit.extent = static_cast<float>(traced.extent(id));
  const double cosine = normal.dot(way.direction);
  hit.front = cosine < 0;
  hit.geometric_normal = normal.cast<float>();
  hit.shading_normal = hit.geometric_normal;
  Eigen::Vector3d position;
  if (id.geometry == TracedScene::discs) {
    // In the disc's own plane: origin + t d is off it by t's rounding.
    const Eigen::Vector3d offset = way.origin - point + static_cast<double>(what.distance) * way.direction;
    position = point + offset - offset.dot(normal) * normal;
    hit.uv.setZero();
    hit.material = prototype.disc_material;
    hit.organ = 0xffffffffu;
  } else {
    const Mesh& mesh = *prototype.mesh;
    const std::array<std::uint32_t, 3>& corners = mesh.triangles[id.primitive];
    const float u = what.u, v = what.v, w = 1 - u - v;
    const auto interpolate = [&](const auto& of) -> std::decay_t<decltype(of[0])> {
      return w * of[corners[0]] + u * of[corners[1]] + v * of[corners[2]];
    };
    position = traced.to_world(what, interpolate(mesh.positions_m));
    if (!mesh.uv.empty()) hit.uv = interpolate(mesh.uv);
    hit.organ = mesh.organ_of_triangle.empty() ? 0xffffffffu : mesh.organ_of_triangle[id.primitive];
    hit.material =
        hit.organ < prototype.material_of_organ.size() ? prototype.material_of_organ[hit.organ] : 0;
    if (!mesh.normals.empty()) {
      // The viewer must see the same side of both normals: else the shading normal is bent until it just
      // does.
      Eigen::Vector3d s = traced.turn(id.instance, interpolate(mesh.normals)).normalized();
      constexpr double least = 1e-3;
      const double side = hit.front ? -1 : 1;
      const double seen = side * s.dot(way.direction);
      if (!(seen > least)) s = (s + side * (least - seen) * way.direction).normalized();
      if (s.allFinite()) hit.shading_normal = s.cast<float>();
    }
  }
  if (periodic) into_cell(position);
  hit.position = position.cast<float>();
}

void Intersector::Impl::describe_ground(const Way& way, double distance, Hit& hit) const {
  hit.distance = static_cast<float>(way.before + distance);
  Eigen::Vector3d position = way.origin + distance * way.direction;
  position.z() = ground->height_m;
  if (periodic) into_cell(position);
  hit.position = position.cast<float>();
  hit.geometric_normal = hit.shading_normal = Eigen::Vector3f::UnitZ();
  hit.front = way.direction.z() < 0;
  hit.material = ground->material;
  hit.organ = 0xffffffffu;
  hit.uv.setZero();
  hit.id = {0, TracedScene::ground, 0};
  hit.extent = 0;
  hit.ground = true;
}

Intersector::Intersector(const Scene& scene, const IntersectorOptions& options)
    : impl_(std::make_unique<Impl>(scene, options)) {}
Intersector::~Intersector() = default;

Escape Intersector::intersect(const Ray& ray, Hit& hit) const {
  Impl::Found found;
  double ground_distance = -1;
  const Escape escape = impl_->trace<false>(ray, found, ground_distance);
  if (escape != Escape::hit) return escape;
  if (ground_distance >= 0) {
    impl_->describe_ground(found.way, ground_distance, hit);
  } else {
    impl_->describe(found, hit);
  }
  return Escape::hit;
}

bool Intersector::occluded(const Ray& ray) const {
  Impl::Found found;
  double ground_distance = -1;
  return impl_->trace<true>(ray, found, ground_distance) == Escape::hit;
}

std::unique_ptr<ParallelRays> Intersector::parallel_rays(const Scene& scene, const Eigen::Vector3d& towards,
                                                         std::uint64_t most_bytes) const {
  return ParallelRays::make(impl_->traced, scene, towards, most_bytes);
}

float Intersector::top_m() const {
  return static_cast<float>(impl_->top);
}
float Intersector::bottom_m() const {
  return static_cast<float>(impl_->bottom);
}
Eigen::Vector2f Intersector::cell_low_m() const {
  return impl_->low.cast<float>();
}
Eigen::Vector2f Intersector::cell_high_m() const {
  return impl_->high.cast<float>();
}
std::uint64_t Intersector::memory_bytes() const {
  return impl_->traced.memory_bytes();
}

}  // namespace bpms
