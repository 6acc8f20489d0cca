// Synthetic canopies whose gap fraction is known: discs of one radius, centres independent and uniform over a
// periodic cell and a layer, normals drawn from a leaf angle distribution, azimuths uniform. For N such discs
// of area a over ground A the gap fraction at zenith t is exactly (1 - G(t) a / (A cos t))^N as long as no
// disc covers itself through the period; it tends to exp(-G LAI / cos t).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "plant/structure/de_wit.h"
#include "scene/scene.h"

namespace bpms {

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
