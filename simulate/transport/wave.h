// Reverse path tracing: from the sensor, a ray to each sun at each interaction (and one into a sky that is
// not even), one ray onward, the sky gathered by the ray that escapes. Many paths advance together, one
// interaction at a time. All rays of an order are traced; then what they met is sorted by where it is, the
// sun's rays are asked for in this order, and the paths go on in it: neighbours read the same part of the
// scene, which is several times as fast as to follow each path to its end.
#pragma once
#include <vector>

#include "core/large_vector.h"
#include "scene/intersect/look_ahead.h"
#include "simulate/transport/places.h"
#include "simulate/transport/sampler.h"
#include "simulate/transport/stage.h"

namespace bpms {

template <class Tally>
class Wave {
 public:
  // `view_rays`, or null, finds the first hits of the one view whose paths are added.
  explicit Wave(const Stage& stage, const ParallelRays* view_rays = nullptr);
  ~Wave();
  Wave(const Wave&) = delete;
  Wave& operator=(const Wave&) = delete;

  // Paths [first, last) of each batch of a view, to be added to tallies[0 ... batches).
  void add(const Sensor& sensor, std::size_t view, const ViewKey& key, std::uint64_t first,
           std::uint64_t last, std::vector<Tally>& tallies);
  std::size_t size() const { return paths_.size(); }
  // Traces all that was added.
  void run();

 private:
  using Weight = typename Tally::Weight;
  // A path on its way: the surface that it is at, and the direction in which it leaves.
  struct alignas(64) Path {
    Weight weight;
    Eigen::Vector3f position, normal, shading, direction;
    SurfaceId surface;
    float extent;
    // Density of the direction, for light that could also have been asked for; from_mirror: it could not (the
    // sensor's own direction, a mirror's, a window's).
    float density;
    std::uint32_t material;
    std::uint32_t batch;  // into numbers_ and tallies_
    std::uint32_t sample;
    std::uint8_t branch;
    bool front, ground;
  };
  static constexpr float from_mirror = -1;
  static constexpr std::size_t no_grid = ~std::size_t{0};

  void release(const Path& path) { tallies_[path.batch]->release(path.weight); }
  void note(std::size_t path);
  void receive_sun(const Eigen::Vector3f& normal, const Ray& ray, Path& path);
  void meet_all(int order);
  // `look`: the first hit's, where the view has a grid.
  bool meet(Path& path, int order, const ParallelRays::Look* look);
  std::uint32_t material_at(const Hit& hit) const;
  void bend(Path& path, const Hit& hit) const;
  void escape(const Path& path, int order);
  void go_on(Path& path, int order);
  bool interact(Path& path, int order);
  bool gather_sun(const Path& path, int order, std::size_t sun, bool& behind);
  void gather_sky(const Path& path, int order);
  bool scatter(Path& path, int order);
  bool scatter_diffuse(Path& path, const InteractionNumbers& random, float share);
  bool scatter_lobe(Path& path, const LobeOptics& lobe, const InteractionNumbers& random, float share);
  bool sees(const Path& path, const Eigen::Vector3f& towards, std::size_t sun, Weight& weight, int& order);
  template <class Visit>
  void each_way(const Path& path, const Eigen::Vector3f& to_light, Visit visit);
  const float* sky_there(const Eigen::Vector3f& towards);

  const Stage& stage_;
  const Light& light_;
  const Sampling& sampling_;
  const ParallelRays* view_rays_;
  MortonCurve curve_;
  std::vector<PathNumbers> numbers_;
  std::vector<Tally*> tallies_;
  struct Memory {
    LargeVector<Path> paths, next;
    std::vector<std::uint64_t> order, unsorted;
  };
  // Kept by the thread for its next wave: to ask the system for it each time takes a twentieth of the time.
  static Memory& spare() {
    thread_local Memory memory;
    return memory;
  }
  LargeVector<Path> paths_, next_;
  std::vector<std::uint64_t> order_, unsorted_;  // place along the curve << 32 | index into paths_
  std::vector<LookAhead> sun_looks_;             // one a sun, or none
  std::size_t now_ = 0;                          // the path that goes on, in order_
  std::vector<float> values_, sky_values_;       // by traced band
};

}  // namespace bpms
