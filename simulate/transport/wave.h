// Reverse path tracing: from the sensor, a ray to the sun at each interaction, one diffuse ray onward, the
// sky gathered by the ray that escapes. Geometric normals throughout, so that no light leaks or is made.
// Many paths advance together, one interaction at a time. All rays of an order are traced; then what they met
// is sorted by where it is, the sun's rays are asked for in this order, and the paths go on in it: neighbours
// read the same part of the scene, which is several times as fast as to follow each path to its end.
#pragma once
#include <vector>

#include "simulate/transport/sampler.h"
#include "simulate/transport/stage.h"

namespace bpms {

template <class Tally>
class Wave {
 public:
  // `view_rays`, or null, finds the first hits of the one view whose paths are added.
  explicit Wave(const Stage& stage, const ParallelRays* view_rays = nullptr);

  // Paths [first, last) of each batch of a view, to be added to tallies[0 ... batches).
  void add(const Sensor& sensor, std::size_t view, const ViewKey& key, std::uint64_t first,
           std::uint64_t last, std::vector<Tally>& tallies);
  std::size_t size() const { return paths_.size(); }
  // Traces all that was added.
  void run();

 private:
  // A path on its way: the surface that it is at, and the direction in which it leaves.
  struct alignas(64) Path {
    typename Tally::Weight weight;
    Eigen::Vector3f position, normal, direction;
    SurfaceId surface;
    float extent;
    std::uint32_t material;
    std::uint32_t batch;  // into numbers_ and tallies_
    std::uint32_t sample;
    bool front, ground;
  };
  void note(std::size_t path);
  void sort();
  bool meet(Path& path, int order);
  bool interact(Path& path, int order);
  bool gather_sun(const Path& path, int order);
  bool scatter(Path& path, int order);

  const Stage& stage_;
  const Light& light_;
  const Sampling& sampling_;
  const ParallelRays* view_rays_;
  Eigen::Vector3f to_sun_, low_;
  float cells_per_m_;
  std::vector<PathNumbers> numbers_;
  std::vector<Tally*> tallies_;
  std::vector<Path> paths_, next_;
  std::vector<std::uint64_t> order_, unsorted_;  // cell << 32 | index into paths_
};

}  // namespace bpms
