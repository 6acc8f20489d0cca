// Rays that all run the same way: towards the sun, or of an orthographic view. Seen along their direction the
// scene is flat: each disc is an ellipse in the plane of (u, v) = (x - z dx/dz, y - z dy/dz), where a ray is
// a point. A grid over that plane lists the ellipses that touch each square, highest first; a ray looks
// through one short list instead of walking down a hierarchy. The answers are those of the Intersector to
// float rounding. Periodic cells wrap in (u, v). For discs and the ground plane; scenes with anything else
// have none (see make).
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/intersect/intersector.h"

namespace bpms {

class TracedScene;

class ParallelRays {
 public:
  // Null where the scene does not suit: meshes, shapes, terrain, discs wider than half a periodic cell, more
  // than `most_bytes`. `towards`: unit, z > 0; from the scene to the sun or the sensor.
  static std::unique_ptr<ParallelRays> make(const TracedScene& traced, const Scene& scene,
                                            const Eigen::Vector3d& towards, std::uint64_t most_bytes);

  // Is there anything between a point of the surface `from` and infinity?
  bool occluded(const Eigen::Vector3f& point, const SurfaceId& from) const;
  // The first hit of a ray that starts above the scene and runs along -towards, through `point`.
  bool first(const Eigen::Vector3f& point, Hit& hit) const;

  // Starts to bring what a ray through this point will read; ask for some rays before they are traced.
  void prefetch(const Eigen::Vector3f& point) const;

  std::uint64_t memory_bytes() const;

 private:
  // A disc seen along the rays. Offsets from its centre: du, dv. Inside where q11 du^2 + q12 du dv + q22 dv^2
  // <= 1; there its height is height + a du + b dv.
  struct alignas(32) Ellipse {
    float u, v, q11, q12, q22, height, a, b;
  };
  // Of a square's list, highest first.
  struct Entry {
    float top;
    std::uint32_t id;
  };
  struct Bounds {  // half_u < 0: seen edge-on, covers nothing
    double u, v, half_u, half_v;
    float top;
  };
  struct Spot {
    std::size_t square;
    float u, v;
  };

  ParallelRays(const TracedScene& traced, const Scene& scene, const Eigen::Vector3d& towards);
  bool build(std::uint64_t most_bytes);
  bool flatten(std::vector<Bounds>& bounds);
  void lay_grid(const std::vector<Bounds>& bounds);
  bool list(const std::vector<Bounds>& bounds, std::uint64_t most_bytes);
  bool spot(double u, double v, Spot& out) const;
  std::size_t number_of(long column, long row) const;
  std::size_t squares() const;
  template <class Visit>
  void squares_of(const Bounds& bounds, Visit visit) const;
  float height_at(const Ellipse& ellipse, float u, float v) const;

  const TracedScene* traced_;
  const Scene* scene_;
  Eigen::Vector3d towards_;
  Eigen::Vector2d shear_;                // dx/dz, dy/dz
  std::vector<std::uint32_t> first_id_;  // of each instance's discs
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d squares_m_ = Eigen::Vector2d::Ones();  // sides, which close on a periodic cell
  long columns_ = 1, rows_ = 1;
  long tiles_across_ = 1;                   // squares are numbered by tiles: neighbours are near in memory
  float wrap_u_, wrap_v_;                   // the period; infinite where there is none
  std::vector<Ellipse> ellipses_;           // by number of the disc over all instances
  std::vector<std::uint32_t> first_entry_;  // of each square, and the end
  std::vector<Entry> entries_;
};

}  // namespace bpms
