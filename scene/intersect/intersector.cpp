#include "scene/intersect/intersector.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/intersect/disc_grid.h"
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
    bool leaves = false;  // a primitive, which it may meet again by rounding
    double rising = 0;    // the sine at which it leaves: above 0 to the upper side
  };
  enum class Met { nothing, geometry, ground };
  struct Found {
    embree::Found what;
    Way way;               // the piece it was met on
    DiscGrid::Found disc;  // where there is a grid
  };

  Way start(const Ray& ray) const;
  void into_cell(Eigen::Vector3d& point) const;
  template <bool any>
  Escape trace(const Ray& ray, Found& found, double& ground_distance) const;
  template <bool any>
  bool piece(const Way& way, double length, embree::Found& found) const;
  template <bool any>
  DiscGrid::End through_grid(double last, Found& found) const;
  bool is_start(const Way& way, const embree::Found& found) const;
  bool is_start_shape(const Way& way, const embree::Found& found, const Eigen::Vector3d& start) const;
  double to_plane(const Way& way) const;
  void describe(const Found& found, Hit& hit) const;
  void describe_in_grid(const Found& found, Hit& hit) const;
  Eigen::Vector3d describe_disc(const Found& found, const Prototype& prototype, Hit& hit) const;
  Eigen::Vector3d describe_triangle(const Found& found, const Prototype& prototype, Hit& hit) const;
  Eigen::Vector3d describe_shape(const Found& found, const Prototype& prototype, Hit& hit) const;
  void describe_ground(const Way& way, double distance, Hit& hit) const;

  TracedScene traced;
  std::unique_ptr<DiscGrid> grid;
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
  if (ground && ground->has_plane()) {
    top = std::max(top, ground->height_m);
    bottom = std::min(bottom, ground->height_m);
  }
  if (!(top >= bottom)) top = bottom = 0;
  if (!periodic && !(high.x() >= low.x())) low = high = Eigen::Vector2d::Zero();
  if (!periodic && size.minCoeff() > 0) low = -0.5 * size, high = 0.5 * size;
  // Never 0: a ray that was brought down to the top of a bare plane must not start beneath it.
  constexpr double least_height_m = 0.1;
  slack = 1e-5 * std::max({std::abs(top), std::abs(bottom), top - bottom, least_height_m});
  lift = traced.instanced() ? lift_instanced : lift_flat;
  if (options.disc_grid) {
    std::uint64_t most_bytes = std::uint64_t{1} << 28;
    if (options.most_bytes > 0)
      most_bytes =
          std::min(most_bytes, options.most_bytes - std::min(options.most_bytes, traced.estimated_bytes()));
    grid = DiscGrid::make(traced, scene, most_bytes);
  }
}

void Intersector::Impl::into_cell(Eigen::Vector3d& point) const {
  for (int axis = 0; axis < 2; ++axis) {
    if (point[axis] >= low[axis] && point[axis] < high[axis]) continue;
    point[axis] -= size[axis] * std::floor((point[axis] - low[axis]) / size[axis]);
  }
}

Intersector::Impl::Way Intersector::Impl::start(const Ray& ray) const {
  Way way{ray.origin.cast<double>(), ray.direction.cast<double>(), ray.far, 0, 0, ray.from, false, 0};
  if (periodic) into_cell(way.origin);
  if (grid) return way;  // which tells the ray's own disc by its number
  way.lift = lift * (way.origin.cwiseAbs().maxCoeff() + 1e-3);
  if (TracedScene::is_primitive(way.from)) {
    // A point of a wide triangle near the scene's origin is as inexact as the triangle's far corners.
    const bool known = ray.from_extent >= 0;
    way.lift += lift * (known ? static_cast<double>(ray.from_extent) : traced.extent(way.from));
    const Eigen::Vector3d n =
        known ? ray.from_normal.cast<double>().eval() : traced.normal(way.from, way.origin);
    way.leaves = true;
    way.rising = n.dot(way.direction);
    double by = way.lift;
    if (way.from.geometry == TracedScene::shapes && way.rising < 0) {
      // Inside, hits on itself are told apart by name: it need only be sure to be inside, and must not get
      // out again through the far side or past an edge.
      constexpr double inwards = 0.25, part = 0.05;
      by = std::min(inwards * by, part * traced.thinnest(way.from));
    }
    way.origin += (way.rising < 0 ? -by : by) * n;
  }
  return way;
}

// Is this the very element that the ray started on (and not a shifted copy of it)?
bool Intersector::Impl::is_start(const Way& way, const embree::Found& found) const {
  const SurfaceId id = traced.id(found);
  if (id.instance != way.from.instance || id.geometry != way.from.geometry) return false;
  const Eigen::Vector3d start = way.origin - way.before * way.direction;
  if (id.geometry == TracedScene::shapes)
    return id.primitive / 4 == way.from.primitive / 4 && is_start_shape(way, found, start);
  if (id.primitive != way.from.primitive) return false;
  const TracedScene::Plane plane = traced.plane(found);
  return std::abs((start - plane.point).dot(plane.normal)) <= 4 * way.lift;
}

// All shapes are convex: what leaves one to the outside does not meet it again; what goes in comes out once,
// and does not come in again.
bool Intersector::Impl::is_start_shape(const Way& way, const embree::Found& found,
                                       const Eigen::Vector3d& start) const {
  if (std::abs(traced.shape_offset_of(found, static_cast<int>(way.from.primitive % 4), start)) > 4 * way.lift)
    return false;
  return way.rising >= 0 || traced.shape_at(found).normal.dot(way.direction) < 0;
}

// Is anything met between the way's origin and `length`? For any = true, `found` may stay as it is.
template <bool any>
bool Intersector::Impl::piece(const Way& way, double length, embree::Found& found) const {
  embree::Segment segment{way.origin.cast<float>(), 0, way.direction.cast<float>(),
                          static_cast<float>(length)};
  if constexpr (any) {
    // To be inside a shape is to be within rounding of its other side, perhaps.
    const bool in_shape = way.from.geometry == TracedScene::shapes && way.rising < 0;
    if (!way.leaves || (std::abs(way.rising) > grazing && !in_shape)) return traced.bvh().occluded(segment);
  }
  while (traced.bvh().intersect(segment, found)) {
    if (!way.leaves || !is_start(way, found)) return true;
    segment.near = std::nextafter(found.distance, std::numeric_limits<float>::infinity());
    if (segment.near > segment.far) return false;
  }
  return false;
}

// Along the piece, to the ground's plane where that is to be seen.
double Intersector::Impl::to_plane(const Way& way) const {
  const double t = (ground->height_m - way.origin.z()) / way.direction.z();
  if (!ground->terrain) return t;
  const Eigen::Vector2d at = (way.origin + t * way.direction).head<2>();
  return ground->terrain->covers(at) ? infinity : t;
}

template <bool any>
DiscGrid::End Intersector::Impl::through_grid(double last, Found& found) const {
  const Way& way = found.way;
  DiscGrid::Query query{way.origin, way.direction, last, DiscGrid::none, any, max_wraps};
  if (way.from.geometry == TracedScene::discs)
    query.skip = grid->first_id(way.from.instance) + way.from.primitive;
  return grid->first(query, found.disc);
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
  const bool may_meet_ground = ground && ground->has_plane() && way.from.geometry != TracedScene::ground &&
                               (way.origin.z() >= ground->height_m ? dz < 0 : dz > 0);
  if (grid) {
    const double to_far = way.far - way.before;
    // Ground beneath all discs is met by what met none of them.
    const bool among = may_meet_ground && ground->height_m > traced.box().low.z();
    const DiscGrid::End met = through_grid<any>(among ? std::min(to_far, to_plane(way)) : to_far, found);
    if (met == DiscGrid::End::disc) return Escape::hit;
    if (met == DiscGrid::End::wraps) return Escape::wrap_limit;
    if (may_meet_ground) {
      ground_distance = to_plane(way);
      if (ground_distance <= to_far) return Escape::hit;
      ground_distance = -1;
    }
    return dz < 0 ? Escape::bottom : Escape::top;
  }
  for (int wraps = 0;; ++wraps) {
    const double to_far = way.far - way.before;
    if (to_far < 0) return dz < 0 ? Escape::bottom : Escape::top;
    const double to_ground = may_meet_ground ? to_plane(way) : infinity;
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
  if (grid) return describe_in_grid(found, hit);
  const embree::Found& what = found.what;
  const Way& way = found.way;
  const SurfaceId id = traced.id(what);
  const Prototype& prototype = traced.prototype(id.instance);
  hit.id = id;
  hit.distance = static_cast<float>(way.before + what.distance);
  hit.ground = false;
  hit.organ = 0xffffffffu;
  Eigen::Vector3d position;
  if (id.geometry == TracedScene::discs) {
    position = describe_disc(found, prototype, hit);
  } else if (id.geometry == TracedScene::triangles) {
    position = describe_triangle(found, prototype, hit);
  } else {
    position = describe_shape(found, prototype, hit);
  }
  if (id.geometry != TracedScene::discs) hit.extent = static_cast<float>(traced.extent(id));
  if (periodic) into_cell(position);
  hit.position = position.cast<float>();
}

void Intersector::Impl::describe_in_grid(const Found& found, Hit& hit) const {
  const DiscGrid::Found& disc = found.disc;
  const Prototype& prototype = traced.prototype(disc.instance);
  hit.id = {disc.instance, TracedScene::discs, disc.primitive};
  hit.distance = static_cast<float>(found.way.before + disc.distance);
  hit.ground = false;
  hit.organ = 0xffffffffu;
  hit.extent = static_cast<float>(2 * disc.radius);
  hit.front = disc.normal.dot(found.way.direction) < 0;
  hit.geometric_normal = hit.shading_normal = disc.normal.cast<float>();
  hit.uv.setZero();
  hit.dp_du.setZero();
  hit.dp_dv.setZero();
  hit.material = prototype.material_of_disc.empty() ? prototype.disc_material
                                                    : prototype.material_of_disc[disc.primitive];
  Eigen::Vector3d position = disc.position;
  if (periodic) into_cell(position);
  hit.position = position.cast<float>();
}

Eigen::Vector3d Intersector::Impl::describe_disc(const Found& found, const Prototype& prototype,
                                                 Hit& hit) const {
  const embree::Found& what = found.what;
  const Way& way = found.way;
  double extent = 0;
  const auto [point, normal] = traced.disc(what, hit.id, extent);
  hit.extent = static_cast<float>(extent);
  hit.front = normal.dot(way.direction) < 0;
  hit.geometric_normal = hit.shading_normal = normal.cast<float>();
  hit.uv.setZero();
  hit.dp_du.setZero();
  hit.dp_dv.setZero();
  hit.material = prototype.material_of_disc.empty() ? prototype.disc_material
                                                    : prototype.material_of_disc[hit.id.primitive];
  // In the disc's own plane: origin + t d is off it by t's rounding.
  const Eigen::Vector3d offset = way.origin - point + static_cast<double>(what.distance) * way.direction;
  return point + offset - offset.dot(normal) * normal;
}

Eigen::Vector3d Intersector::Impl::describe_triangle(const Found& found, const Prototype& prototype,
                                                     Hit& hit) const {
  const embree::Found& what = found.what;
  const Way& way = found.way;
  const SurfaceId& id = hit.id;
  const Mesh& mesh = *prototype.mesh;
  const std::array<std::uint32_t, 3>& corners = mesh.triangles[id.primitive];
  const float u = what.u, v = what.v, w = 1 - u - v;
  const auto interpolate = [&](const auto& of) -> std::decay_t<decltype(of[0])> {
    return w * of[corners[0]] + u * of[corners[1]] + v * of[corners[2]];
  };
  const Eigen::Vector3d position =
      traced.to_world(what, interpolate(mesh.positions_m).template cast<double>());
  const Eigen::Vector3d normal = traced.normal(id, position);
  hit.front = normal.dot(way.direction) < 0;
  hit.geometric_normal = hit.shading_normal = normal.cast<float>();
  hit.ground = traced.is_terrain(id.instance);
  if (!mesh.organ_of_triangle.empty()) hit.organ = mesh.organ_of_triangle[id.primitive];
  const std::uint32_t organ = mesh.organ_of_triangle.empty() ? 0 : hit.organ;
  hit.material = organ < prototype.material_of_organ.size() ? prototype.material_of_organ[organ] : 0;
  hit.uv = {u, v};
  hit.dp_du.setZero();
  hit.dp_dv.setZero();
  if (!mesh.uv.empty()) {
    hit.uv = interpolate(mesh.uv);
    const Eigen::Vector3f& p = mesh.positions_m[corners[0]];
    const Eigen::Vector3d e1 = (mesh.positions_m[corners[1]] - p).cast<double>(),
                          e2 = (mesh.positions_m[corners[2]] - p).cast<double>();
    const Eigen::Vector2d t1 = (mesh.uv[corners[1]] - mesh.uv[corners[0]]).cast<double>(),
                          t2 = (mesh.uv[corners[2]] - mesh.uv[corners[0]]).cast<double>();
    const double determinant = t1.x() * t2.y() - t2.x() * t1.y();
    if (std::abs(determinant) > 1e-12 * t1.norm() * t2.norm()) {
      const double by = traced.scale(id.instance) / determinant;
      hit.dp_du = (by * traced.turn(id.instance, t2.y() * e1 - t1.y() * e2)).cast<float>();
      hit.dp_dv = (by * traced.turn(id.instance, t1.x() * e2 - t2.x() * e1)).cast<float>();
    }
  }
  if (!mesh.normals.empty()) {
    // The viewer must see the same side of both normals: else the shading normal is bent until it just does.
    Eigen::Vector3d s =
        traced.turn(id.instance, interpolate(mesh.normals).template cast<double>()).normalized();
    constexpr double least = 1e-3;
    const double side = hit.front ? -1 : 1;
    const double seen = side * s.dot(way.direction);
    if (!(seen > least)) s = (s + side * (least - seen) * way.direction).normalized();
    if (s.allFinite()) hit.shading_normal = s.cast<float>();
  }
  return position;
}

Eigen::Vector3d Intersector::Impl::describe_shape(const Found& found, const Prototype& prototype,
                                                  Hit& hit) const {
  const ShapePoint point = traced.shape_at(found.what);
  hit.front = point.normal.dot(found.way.direction) < 0;
  hit.geometric_normal = hit.shading_normal = point.normal.cast<float>();
  hit.uv = point.uv.cast<float>();
  hit.dp_du = point.dp_du.cast<float>();
  hit.dp_dv = point.dp_dv.cast<float>();
  hit.material = prototype.shapes[hit.id.primitive / 4].material;
  hit.organ = prototype.organ_of(hit.id.primitive / 4);
  return point.position;
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
  hit.dp_du.setZero();
  hit.dp_dv.setZero();
  hit.id = ground_surface;
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

std::uint32_t Intersector::plant_of(const SurfaceId& id) const {
  return TracedScene::is_primitive(id) ? impl_->traced.plant(id.instance) : no_plant;
}

bool Intersector::inside_solid(const Eigen::Vector3d& point) const {
  Eigen::Vector3d at = point;
  if (impl_->periodic) impl_->into_cell(at);
  const std::optional<Ground>& ground = impl_->ground;
  if (ground && (ground->has_plane() || ground->terrain->covers(at.head<2>())) &&
      at.z() < ground->height_at(at.head<2>()))
    return true;
  return impl_->traced.inside_closed_shape(at);
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
  return impl_->traced.memory_bytes() + (impl_->grid ? impl_->grid->memory_bytes() : 0);
}
std::uint64_t Intersector::estimated_bytes() const {
  return impl_->traced.estimated_bytes();
}

}  // namespace bpms
