// What a camera with a hemispherical lens sees that lies on the ground and looks up: sky white, leaves and
// the rest dark. Equidistant projection (distance from the middle = zenith angle), the rim at 90 degrees;
// east on the right and north at the top, as on a map (seen from below they would be exchanged).
#pragma once
#include "core/png.h"
#include "scene/structure/gap_fraction.h"

namespace bpms {

struct FisheyePicture {
  RgbImage image;        // square; white outside of the circle
  double gap_share = 0;  // of the hemisphere's solid angle
};
// `at`: where on the ground. Each pixel is the mean of `rays` x `rays` rays.
FisheyePicture fisheye_picture(const GapScene& scene, const Eigen::Vector2d& at, int pixels, int rays = 2);

}  // namespace bpms
