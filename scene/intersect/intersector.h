// Rays against a scene, on Embree, behind this one header. Periodic domains wrap: a ray that leaves a side
// re-enters on the other until it hits, leaves the top (or bottom), or has wrapped `max_wraps` times.
// Re-entrant: any number of threads may trace at once. Directions are unit vectors.
// One ray a call: Embree's packets of 8 and streams were measured on sun rays of the homogeneous disc canopy
// and gave 0.98 (starts at random) and 0.90 to 1.08 (starts in raster order) of the rate of single rays.
// Order of the rays matters far more: raster order is 3.5 times as fast as random order.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "scene/scene.h"

namespace bpms {

// Names the surface element a ray starts on, so that it is not hit again at once. `instance` is the index
// into Scene::instances (their count for terrain), `geometry` 0 for discs, 1 for the mesh and terrain, 2 for
// the ground plane, 3 for shapes; triangles are numbered as in the mesh, discs in the intersector's own
// order, a shape's number is 4 shape + part (0: its side, 1 and 2: a cylinder's ends).
struct SurfaceId {
  std::uint32_t instance = 0xffffffffu;
  std::uint32_t geometry = 0xffffffffu;
  std::uint32_t primitive = 0xffffffffu;
};

// The ground plane's own name: a ray that starts on the ground.
inline constexpr SurfaceId ground_surface{0, 2, 0};

struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
  float far = 1e30f;  // metres along the ray
  SurfaceId from;
  // Of the surface `from`, where the caller kept them of the Hit; looked up when the extent is negative.
  Eigen::Vector3f from_normal = Eigen::Vector3f::Zero();
  float from_extent = -1;
};

struct Hit {
  float distance = 0;                 // along the unwrapped ray
  Eigen::Vector3f position;           // inside the domain cell when periodic
  Eigen::Vector3f geometric_normal;   // unit, of the upper face (of a shape, the outer one)
  Eigen::Vector3f shading_normal;     // unit, same side; differs from the geometric one for meshes alone
  bool front = true;                  // the ray met the upper (outer) face
  std::uint32_t material = 0;         // index into Scene::materials
  std::uint32_t organ = 0xffffffffu;  // index into the prototype's mesh organs
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
  // Tangents: how the position changes with U and with V; zero where there is no (U,V).
  Eigen::Vector3f dp_du = Eigen::Vector3f::Zero();
  Eigen::Vector3f dp_dv = Eigen::Vector3f::Zero();
  SurfaceId id;
  float extent = 0;     // no two points of the disc, triangle or shape are further apart along an axis
  bool ground = false;  // the plane or terrain
};

enum class Escape { hit, top, bottom, wrap_limit };

struct IntersectorOptions {
  int max_wraps = 1000;  // of a ray in a periodic domain
  // Prototypes that stand more than once are instanced when all their instances have more primitives than
  // this.
  std::uint64_t flatten_below = 100'000;
  // A scene that is estimated to need more is refused (missing_resource) before anything is built; 0: no
  // limit.
  std::uint64_t most_bytes = 0;
  // Discs that fill the scene evenly are traced through cells (disc_grid.h) and not through Embree.
  bool disc_grid = true;
};

class ParallelRays;

class Intersector {
 public:
  explicit Intersector(const Scene& scene, const IntersectorOptions& options = {});
  ~Intersector();
  Intersector(const Intersector&) = delete;
  Intersector& operator=(const Intersector&) = delete;

  Escape intersect(const Ray& ray, Hit& hit) const;
  bool occluded(const Ray& ray) const;  // anything between 0 and far (opaque or not)

  // For many rays of one direction (see parallel_rays.h), or null where the scene does not suit. Both the
  // intersector and the scene that it was made of must outlive it. `towards` is unit, with z > 0.
  std::unique_ptr<ParallelRays> parallel_rays(const Scene& scene, const Eigen::Vector3d& towards,
                                              std::uint64_t most_bytes = 1u << 29) const;

  // The plant that a surface is a part of (Instance::plant; where the scene says none, the instance);
  // no_plant for the ground.
  std::uint32_t plant_of(const SurfaceId& id) const;
  // Does a point lie in a closed shape, or below the ground? No sensor can stand there. It looks at every
  // instance.
  bool inside_solid(const Eigen::Vector3d& point) const;

  float top_m() const;  // highest point of the scene (geometry and ground)
  float bottom_m() const;
  Eigen::Vector2f cell_low_m() const;  // the domain cell, or the bounding box of an open scene
  Eigen::Vector2f cell_high_m() const;
  // What Embree counts (it leaves out some 160 bytes an instance) and what is kept beside it.
  std::uint64_t memory_bytes() const;
  std::uint64_t estimated_bytes() const;  // what was expected before it was built

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bpms
