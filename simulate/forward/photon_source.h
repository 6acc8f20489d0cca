// Where photons start: one source for each sun and one for the sky, kept apart so that every result knows its
// origin. A photon of a source carries in each band the same share of what that source sends into the scene.
//
// Suns may be discs, and skies maps. Periodic scenes are lit through the horizontal cell at the top, open
// ones through the faces of their box (top and the sides that the light meets); the surroundings are black
// and infinite, the ground goes no further than the box. `entering_m2` is the horizontal area that receives
// the same power. What comes from a direction enters by way of the box's area as that direction sees it.
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
  std::vector<double> entering_m2;
  bool is_sun = true;
  Eigen::Vector3d towards = Eigen::Vector3d::UnitZ();  // the sun

 private:
  friend std::vector<PhotonSource> photon_sources(const Simulation& simulation, const Extent& extent);
  static constexpr std::size_t faces = 5;  // top, -x, +x, -y, +y
  using Faces = std::array<double, faces>;
  void place(const Extent& extent, bool periodic);
  // The areas of the faces as seen from a direction (towards the light); nothing from below the horizon.
  Faces seen_from(const Eigen::Vector3d& from) const;
  double mean_over_disc() const;  // of the area as seen from there
  void integrate_map();
  Eigen::Vector3d draw_even(std::size_t face, double u, double v) const;
  void weigh_map(const Eigen::Vector3f& from, float* weight) const;

  Eigen::Vector3d low_, high_;
  Faces area_{};             // 0: no light comes in there
  double even_m2_ = 0;       // what an isotropic sky sends in, as if on the horizontal
  Faces even_{}, centre_{};  // by face: of an isotropic sky, and from the sun's centre
  double margin_m_ = 0;      // starts lie that far outside
  double cos_radius_ = 1;    // of a sun's disc
  double disc_m2_ = 0;       // the mean over it
  std::shared_ptr<const SkyMap> map_;
  double by_map_ = 1;  // the chance with which a direction is drawn as the map is bright
};

std::vector<PhotonSource> photon_sources(const Simulation& simulation, const Extent& extent);

}  // namespace bpms
