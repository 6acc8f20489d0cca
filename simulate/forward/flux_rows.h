// The rows of a flux result, and the sums of one batch over them.
#pragma once
#include <vector>

#include "simulate/forward/forward.h"
#include "simulate/forward/photon_wave.h"

namespace bpms {

class FluxRows {
 public:
  FluxRows(const PhotonStage& stage, const FluxOptions& options);
  const std::vector<FluxRow>& all() const { return rows_; }

  static constexpr std::size_t none = ~std::size_t{0};
  std::size_t of(Flux whole) const { return static_cast<std::size_t>(whole); }  // up to absorbed_ground
  std::size_t material(std::uint32_t material) const { return first_material_ + material; }
  std::size_t organ(const Photon& photon) const;
  std::size_t plant(const Photon& photon) const;
  std::size_t layer(const Photon& photon) const;
  std::size_t pixel(const Photon& photon) const;
  double pixels() const { return static_cast<double>(map_px_[0]) * map_px_[1]; }

 private:
  const Scene* scene_;
  Extent extent_;
  std::vector<FluxRow> rows_;
  std::vector<std::size_t> plant_of_instance_;
  std::size_t first_material_ = 0, first_plant_ = none, first_layer_ = none, first_pixel_ = none;
  std::vector<std::size_t> first_organ_;  // by prototype
  std::vector<double> edges_m_;
  std::array<int, 2> map_px_;
};

// A Sink (photon_wave.h) that adds up one batch of one source.
class FluxTally {
 public:
  FluxTally(const PhotonStage& stage, const FluxRows& rows)
      : stage_(&stage), rows_(&rows), sums_(rows.all().size() * stage.optics.width, 0.0) {}
  void arrive(const Photon& photon, const float* weight, int order);
  void absorb(const Photon& photon, const float* weight);
  void leave(const Photon& photon, const float* weight, int order, Exit exit);

  std::uint64_t photons = 0, rays = 0;
  // Per photon.
  double mean(std::size_t row, std::size_t band) const {
    return sums_[row * stage_->optics.width + band] / static_cast<double>(photons);
  }

 private:
  void add(std::size_t row, const float* weight);
  const PhotonStage* stage_;
  const FluxRows* rows_;
  std::vector<double> sums_;
};

}  // namespace bpms
