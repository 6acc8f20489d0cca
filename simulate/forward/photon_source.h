// Where photons start: one source for each sun and one for the sky, kept apart so that every result knows its
// origin. A photon of a source carries in each band the same share of what that source sends into the scene.
//
// Suns may be discs, and skies maps, over periodic scenes. These are lit through the horizontal cell at the
// top. Open scenes are lit through the faces of their box (top and the sides that the light meets); the
// surroundings are black and infinite, the ground goes no further than the box. `entering_m2` is the
// horizontal area that receives the same power.
#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "simulate/simulate.h"

namespace bpms {

class PhotonSource {
 public:
  struct Start {
    Eigen::Vector3f origin, direction;
  };
  // `numbers`: two for the place, two for the direction (used when has_directions). Multiplies into `weight`,
  // a float a band, what a photon of this direction carries more or less than the mean.
  Start start(const std::array<double, 4>& numbers, float* weight) const;
  bool has_directions() const { return !is_sun || cos_radius_ < 1; }

  Origin origin = Origin::direct;
  int sun = -1;                    // which; -1: the sky
  std::vector<double> irradiance;  // on the horizontal, per traced band
  double entering_m2 = 0;
  bool is_sun = true;
  Eigen::Vector3d towards = Eigen::Vector3d::UnitZ();  // the sun

 private:
  friend std::vector<PhotonSource> photon_sources(const Simulation& simulation, const Extent& extent);
  void place(const Extent& extent, bool periodic);
  Eigen::Vector3d low_, high_;
  std::array<double, 5> upto_{};  // shares of the faces, summed up: top, -x, +x, -y, +y
  double margin_m_ = 0;           // starts lie that far outside
  double cos_radius_ = 1;         // of a sun's disc
  std::shared_ptr<const SkyMap> map_;
};

std::vector<PhotonSource> photon_sources(const Simulation& simulation, const Extent& extent);

}  // namespace bpms
