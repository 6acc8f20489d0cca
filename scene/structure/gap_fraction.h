// Gap fraction P by rays: the share of the footprint from which the sky is seen in a direction. Rays start
// uniformly on the ground (the lowest point without one) and look up; a periodic scene is infinite. Each ray
// asks of the leaves and of all else apart, so that one set of rays gives the gaps of the whole (`plant`), of
// leaves alone (as if nothing else stood there) and of the rest alone (stems).
//
// Points are 32 independent Owen-scrambled Sobol sets, whose spread gives the standard error; where no set
// saw both gap and leaf it is 1 / (rays + 1). It is the error of the rays on this canopy, not of the canopy
// as a sample of a field. The same bits on any number of threads.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "scene/intersect/intersector.h"
#include "scene/structure/footprint.h"

namespace bpms {

// What stands there, ready for rays, and where they start.
class GapScene {
 public:
  explicit GapScene(const Scene& scene);
  const Footprint& footprint() const { return footprint_; }
  const Ground& level() const { return level_; }  // the ground, or the lowest point of what has none
  // A ray from a point on the ground, upwards.
  bool meets_leaf(const Eigen::Vector3f& from, const Eigen::Vector3f& direction) const;
  bool meets_other(const Eigen::Vector3f& from, const Eigen::Vector3f& direction) const;
  // On the ground, a hair above where it is terrain.
  Eigen::Vector3f on_ground(const Eigen::Vector2d& at) const;

 private:
  Footprint footprint_;
  Ground level_;
  std::unique_ptr<Intersector> leaves_, others_;  // null where there are none
};
// The ground, or for a scene without one the level that its gaps are looked at from: 0, or its lowest point.
Ground ground_level(const Scene& scene);

struct GapOptions {
  std::uint32_t rays = 1u << 16;  // for each direction; rounded up to 32 x 2^k. With a target: at most
  std::uint64_t seed = 1;
  double target_se = 0;  // ends a zenith angle when its standard errors are below; 0: none
};

// A zenith angle, or a ring of them (by solid angle), and a sector of azimuths counter-clockwise from x.
struct GapDirection {
  double zenith = 0, zenith_to = 0;  // radians; equal: that angle alone
  double azimuth = 0, width = 6.283185307179586;
};

struct GapShare {
  double p = 0, standard_error = 0;
};
struct Gap {
  GapDirection direction;
  GapShare plant, leaves, others;
  std::uint64_t rays = 0;
  double zenith_deg() const;
};
std::vector<Gap> gap_fraction(const GapScene& scene, const std::vector<GapDirection>& directions,
                              const GapOptions& options = {});

// These zenith angles, each cut into sectors (azimuth 0 in the middle of the first), sectors innermost.
std::vector<GapDirection> gap_directions(const std::vector<double>& zenith_deg, int sectors = 1);
// One row for each `sectors` rows: their mean.
std::vector<Gap> mean_over_azimuth(const std::vector<Gap>& gaps, int sectors);

std::vector<double> usual_gap_angles_deg();  // 0, 5, ... 85 and 57.5

}  // namespace bpms
