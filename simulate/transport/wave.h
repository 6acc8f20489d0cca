// Reverse path tracing: from the sensor, a ray to the sun at each interaction, one diffuse ray onward, the
// sky gathered by the ray that escapes. Geometric normals throughout, so that no light leaks or is made.
// Many paths advance together, one interaction at a time, in the order of where they are: neighbours read the
// same part of the scene, which is several times as fast as to follow each path to its end.
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
  // A path on its way: the ray that it goes on with.
  struct Path {
    Ray ray;
    typename Tally::Weight weight;
    std::uint32_t batch;  // into numbers_ and tallies_
    std::uint32_t sample;
  };
  void sort();
  void advance(std::size_t from, std::size_t to, int order);
  bool meet(const Path& path, int order, Hit& hit);
  bool interact(Path& path, int order, const Hit& hit);
  bool gather_sun(const Path& path, int order, const Hit& hit);
  bool scatter(Path& path, int order, const Hit& hit);

  const Stage& stage_;
  const Light& light_;
  const Sampling& sampling_;
  const ParallelRays* view_rays_;
  Eigen::Vector3f to_sun_, low_;
  float cells_per_m_;
  std::vector<PathNumbers> numbers_;
  std::vector<Tally*> tallies_;
  std::vector<Path> paths_, next_;
  std::vector<std::uint64_t> order_;
};

}  // namespace bpms
