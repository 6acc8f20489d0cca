// Photons from the light through the scene, all of a batch's side by side, one interaction at a time: their
// rays are traced, what they met is sorted along a Morton curve, and they go on in that order, so that
// neighbours read the same part of the scene (as the waves from the sensor do, transport/wave.h). Geometric
// normals; roulette by the largest weight, without bias.
//
// A Sink receives what happens, in an order that depends on the samples alone:
//   void arrive(const Photon&, const float* weight, int order)   at a surface, before it scatters there
//   void absorb(const Photon&, const float* weight)              what of it stays there
//   void leave(const Photon&, const float* weight, int order, Exit)
// `order`: interactions so far. Weights: one float a band, 1 at the start unless the source colours them.
#pragma once
#include <cstdint>
#include <vector>

#include "simulate/forward/photon_optics.h"
#include "simulate/forward/photon_source.h"
#include "simulate/transport/places.h"
#include "simulate/transport/sampler.h"
#include "simulate/transport/stage.h"

namespace bpms {

enum class Exit { top, bottom, side, wraps };

struct Photon {
  Eigen::Vector3f position, normal, direction;
  SurfaceId surface;
  float extent;
  std::uint32_t material, organ;
  std::uint32_t sample, slot;
  bool front, ground;
  bool grounded;   // has been at the ground before
  bool scattered;  // has changed its direction
};

// What all photons share.
struct PhotonStage {
  PhotonStage(const Simulation& simulation, const Intersector& intersector);
  const Simulation* simulation;
  const Intersector* intersector;
  PhotonOptics optics;
  Extent extent;
  std::vector<PhotonSource> sources;
};

template <class Sink>
class PhotonWave {
 public:
  PhotonWave(const PhotonStage& stage, Sink& sink) : stage_(stage), sink_(sink), lost_(stage.optics.width) {}
  // `rays` towards the source, where it is a sun and the scene suits; else null.
  void run(const PhotonSource& source, const ParallelRays* rays, const ViewKey& key, std::uint32_t batch,
           std::uint64_t first, std::uint64_t last);
  std::uint64_t rays() const { return traced_; }

 private:
  bool meet(Photon& photon, const ParallelRays* rays, int order);
  bool scatter(Photon& photon, InteractionNumbers random);
  float* weight(const Photon& photon) { return weights_.data() + photon.slot * stage_.optics.width; }

  const PhotonStage& stage_;
  Sink& sink_;
  std::vector<Photon> photons_, next_;
  std::vector<float> weights_, lost_;
  std::vector<std::uint64_t> order_;  // place along the curve << 32 | index into photons_
  std::uint64_t traced_ = 0;
};

// New direction and weights, by the diffuse part, which was chosen with that chance.
void scatter_diffuse(Photon& photon, const PhotonOptics& optics, const InteractionNumbers& random,
                     float chosen, float* weight);
// By any part of a surface that has lobes. They are reciprocal: what the sensor's side is to a lobe, the
// photon's is here. False: it ends.
bool scatter_lobes(Photon& photon, const PhotonOptics& optics, InteractionNumbers random, float* weight);
// How a ray from `position` leaves, given that it met nothing.
Exit exit_of(const Photon& photon, Escape escape, const Extent& extent, bool periodic);
// Is a point of the ground (or the top) within the box?
bool within(const Eigen::Vector3f& point, const Extent& extent);

template <class Sink>
void PhotonWave<Sink>::run(const PhotonSource& source, const ParallelRays* rays, const ViewKey& key,
                           std::uint32_t batch, std::uint64_t first, std::uint64_t last) {
  const std::size_t width = stage_.optics.width;
  PathNumbers numbers(key, batch);
  photons_.clear();
  next_.resize(last - first);
  weights_.assign((last - first) * width, 0.0f);
  for (std::uint64_t sample = first; sample < last; ++sample) {
    numbers.start(sample);
    const auto place = numbers.position();
    std::array<double, 4> four{place[0], place[1], 0.5, 0.5};
    if (source.has_directions()) {
      const InteractionNumbers direction = numbers.interaction(0);
      four[2] = direction.direction_u, four[3] = direction.direction_v;
    }
    Photon& photon = next_[sample - first];
    photon.slot = static_cast<std::uint32_t>(sample - first);
    photon.sample = static_cast<std::uint32_t>(sample);
    std::fill_n(weight(photon), stage_.optics.bands, 1.0f);
    const PhotonSource::Start start = source.start(four, weight(photon));
    photon.position = start.origin;
    photon.direction = start.direction;
    photon.surface = SurfaceId{};
    photon.extent = -1;
    photon.grounded = photon.scattered = false;
  }
  const std::uint32_t shift = source.has_directions() ? 1 : 0;  // that used the first interaction's numbers
  const int most = stage_.simulation->sampling.max_order;
  std::vector<std::uint64_t> spare;
  const MortonCurve curve(stage_.extent);
  const auto sort = [&](std::vector<Photon>& photons) {
    order_.clear();
    for (std::size_t i = 0; i < photons.size(); ++i)
      order_.push_back(std::uint64_t{curve.place(photons[i].position)} << 32 | i);
    sort_places(order_, spare);
  };
  sort(next_);
  for (const std::uint64_t item : order_) photons_.push_back(next_[item & index_of_place]);
  for (int order = 0; !photons_.empty(); ++order) {
    next_.clear();
    for (Photon& photon : photons_)
      if (meet(photon, rays, order)) next_.push_back(photon);
    photons_.clear();
    sort(next_);
    for (const std::uint64_t item : order_) {
      Photon& photon = next_[item & index_of_place];
      sink_.arrive(photon, weight(photon), order);
      numbers.start(photon.sample);
      if (scatter(photon, numbers.interaction(static_cast<std::uint32_t>(order) + shift)) &&
          (most == 0 || order + 1 < most))
        photons_.push_back(photon);
    }
  }
}

template <class Sink>
bool PhotonWave<Sink>::meet(Photon& photon, const ParallelRays* rays, int order) {
  Hit hit;
  Escape end = Escape::bottom;
  ++traced_;
  if (order == 0 && rays != nullptr) {
    if (rays->first(photon.position, hit)) end = Escape::hit;
  } else {
    end = stage_.intersector->intersect(
        {photon.position, photon.direction, 1e30f, photon.surface, photon.normal, photon.extent}, hit);
  }
  const bool periodic = stage_.simulation->scene.domain.periodic;
  if (end != Escape::hit || (!periodic && hit.ground && !within(hit.position, stage_.extent))) {
    sink_.leave(photon, weight(photon), order,
                end == Escape::hit ? Exit::side : exit_of(photon, end, stage_.extent, periodic));
    return false;
  }
  photon.position = hit.position;
  photon.normal = hit.geometric_normal;
  photon.surface = hit.id;
  photon.extent = hit.extent;
  photon.material = stage_.optics.material_at(hit);
  photon.organ = hit.organ;
  photon.front = hit.front;
  photon.ground = hit.ground;
  return true;
}

template <class Sink>
bool PhotonWave<Sink>::scatter(Photon& photon, InteractionNumbers random) {
  const std::size_t width = stage_.optics.width;
  float* of = weight(photon);
  const SurfaceOptics& surface = stage_.optics.surface(photon.material);
  bool goes_on = true;
  if (surface.diffuse) {
    const float* absorbed = stage_.optics.absorbed(photon.material, photon.front);
    for (std::size_t b = 0; b < width; ++b) lost_[b] = of[b] * absorbed[b];
    scatter_diffuse(photon, stage_.optics, random, 1, of);
  } else {
    // What stays is what does not go on: right in the mean, though not photon by photon.
    std::copy_n(of, width, lost_.begin());
    goes_on = scatter_lobes(photon, stage_.optics, random, of);
    for (std::size_t b = 0; b < width; ++b) lost_[b] -= goes_on ? of[b] : 0.0f;
  }
  sink_.absorb(photon, lost_.data());
  photon.grounded = photon.grounded || photon.ground;
  const float strength = largest_weight(of, width);
  if (!goes_on || !(strength > 0)) return false;
  if (stage_.simulation->sampling.roulette) {
    constexpr float factor = 1.6f;  // as from the sensor (transport/wave.cpp)
    const float survival = factor * strength;
    if (random.survival >= static_cast<double>(survival)) return false;
    if (survival < 1.0f) scale_weights(of, 1.0f / survival, width);
  }
  return true;
}

}  // namespace bpms
