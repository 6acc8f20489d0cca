// Synthetic canopies whose gap fraction is known: discs of one radius, centres independent and uniform over a
// periodic cell and a layer, normals drawn from a leaf angle distribution, azimuths uniform. For N such discs
// of area a over ground A the gap fraction at zenith t is exactly (1 - G(t) a / (A cos t))^N as long as no
// disc covers itself through the period; it tends to exp(-G LAI / cos t).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace bpms {

// Leaf inclination from the horizontal = zenith of the upper normal (de Wit 1965).
enum class LeafAngles { spherical, planophile, erectophile, plagiophile, extremophile, uniform };

// Density of the inclination in [0, pi/2], per radian.
double leaf_angle_density(LeafAngles angles, double inclination);
// The inclination at cumulative probability u.
double leaf_angle_quantile(LeafAngles angles, double u);
// G(t): projection of one-sided unit leaf area on the plane normal to a direction of zenith t.
double g_function(LeafAngles angles, double zenith);

struct RandomDiscs {
  double lai = 3;
  double radius_m = 0.05;
  Eigen::Vector2d size_m{25, 25};
  double bottom_m = 0;  // of the layer that holds the centres
  double top_m = 2;
  LeafAngles angles = LeafAngles::spherical;
  std::uint64_t seed = 1;
};
std::vector<Disc> random_discs(const RandomDiscs& what);
// The same as a periodic scene with a ground plane at 0: one instance, materials "leaf" (0) and "soil" (1).
Scene random_disc_scene(const RandomDiscs& what);

}  // namespace bpms
