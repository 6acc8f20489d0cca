// Where photons start: one source for each sun and one for the sky, kept apart so that every result knows its
// origin. A photon of a source carries in each band the same share of what that source sends into the scene.
//
// Periodic scenes are lit through the horizontal cell at the top. Open scenes are lit through the faces of
// their box (top and the sides that the light meets); the surroundings are black and infinite, the ground
// goes no further than the box. `entering_m2` is the horizontal area that receives the same power.
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "simulate/simulate.h"

namespace bpms {

class PhotonSource {
 public:
  struct Start {
    Eigen::Vector3f origin, direction;
  };
  // `numbers`: two for the place, two for the direction (a sun does not use those). Weights of the bands are
  // multiplied into `weight` where they differ (by `width`, a multiple of 8 that the bands are padded to).
  Start start(const std::array<double, 4>& numbers, float* weight) const;

  Origin origin = Origin::direct;
  std::vector<double> irradiance;  // on the horizontal, per band
  double entering_m2 = 0;
  bool is_sun = true;
  Eigen::Vector3d towards = Eigen::Vector3d::UnitZ();  // the sun

 private:
  friend std::vector<PhotonSource> photon_sources(const Simulation& simulation, const Extent& extent);
  void place(const Extent& extent, bool periodic);
  Eigen::Vector3d low_, high_;
  std::array<double, 5> upto_{};  // shares of the faces, summed up: top, -x, +x, -y, +y
  double margin_m_ = 0;           // starts lie that far outside
};

std::vector<PhotonSource> photon_sources(const Simulation& simulation, const Extent& extent);

}  // namespace bpms
