// Rays that all run the same way: towards the sun, or of an orthographic view. Seen along their direction the
// scene is flat, and a ray looks through one short list of discs (flat_discs.h) instead of walking down a
// hierarchy. Prototypes that stand several times turned and scaled alike are flattened once, and a coarse
// grid says where they stand: HET01's 15 crowns take a fifteenth of the time and the memory. The answers are
// those of the Intersector to float rounding. Periodic cells wrap in (u, v). For discs and the ground plane;
// scenes with meshes have none (see make).
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/intersect/flat_discs.h"
#include "scene/intersect/intersector.h"

namespace bpms {

class TracedScene;

class ParallelRays {
 public:
  // Null where the scene does not suit: meshes, shapes, terrain, discs wider than half a periodic cell, more
  // than `most_bytes`. `towards`: unit, z > 0; from the scene to the sun or the sensor.
  static std::unique_ptr<ParallelRays> make(const TracedScene& traced, const Scene& scene,
                                            const Eigen::Vector3d& towards, std::uint64_t most_bytes);

  // Where in the grids the ray through a point is.
  struct Look {
    Eigen::Vector2d at;  // (u, v)
    FlatDiscs::Spot spot;
    bool any;  // spot is known: something may be there, besides what stands
  };
  Look look(const Eigen::Vector3f& point) const {
    Look out{flat(point), {}, false};
    out.any = !rest_.empty() && rest_.spot(out.at.x(), out.at.y(), out.spot);
    return out;
  }
  // Starts to bring what the ray will read from memory: stages 0, 1, 2, each a few rays before the next.
  void bring(const Look& look, int stage) const {
    if (!look.any) return;
    if (stage == 0) rest_.bring_square(look.spot);
    if (stage == 1) rest_.bring_list(look.spot);
    if (stage == 2) rest_.bring_disc(look.spot);
  }
  // Is there anything between a point of the surface `from` and infinity?
  bool occluded(const Look& look, float z, const SurfaceId& from) const;
  bool occluded(const Eigen::Vector3f& point, const SurfaceId& from) const {
    return occluded(look(point), point.z(), from);
  }
  // The first hit of a ray that starts above the scene and runs along -towards, through `point`.
  bool first(const Look& look, float z, Hit& hit) const;
  bool first(const Eigen::Vector3f& point, Hit& hit) const { return first(look(point), point.z(), hit); }

  std::uint64_t memory_bytes() const;

 private:
  // A flattened prototype where an instance (or a copy of it, some periods away) stands.
  struct Standing {
    double u, v;  // of its origin
    float z, top;
    Eigen::Vector2f low, high;  // what it covers, from its origin
    std::uint32_t group, instance;
  };

  ParallelRays(const TracedScene& traced, const Scene& scene, const Eigen::Vector3d& towards);
  bool build(std::uint64_t most_bytes);
  void stand(std::uint32_t instance, std::uint32_t group);
  void list_standing();
  void add_discs(std::uint32_t instance, bool at_origin, FlatDiscs& to) const;
  Eigen::Vector2d flat(const Eigen::Vector3f& point) const {  // (u, v)
    const Eigen::Vector3d p = point.cast<double>();
    return p.head<2>() - p.z() * shear_;
  }
  template <class Visit>
  void visit_standing(Eigen::Vector2d at, float above, Visit visit) const;
  void describe(std::uint32_t instance, std::uint32_t primitive, Hit& hit) const;

  const TracedScene* traced_;
  const Scene* scene_;
  Eigen::Vector3d towards_;
  Eigen::Vector2d shear_;          // dx/dz, dy/dz
  std::vector<FlatDiscs> groups_;  // of what stands several times
  FlatDiscs rest_;                 // all else, in the scene's own frame
  std::vector<std::uint32_t>
      first_id_;  // of each instance's discs among the rest; the next one's if it has none
  std::vector<Standing> standing_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero(), squares_per_m_ = Eigen::Vector2d::Zero();
  std::vector<std::uint32_t> first_standing_, listed_;  // by coarse square, highest first
};

}  // namespace bpms
