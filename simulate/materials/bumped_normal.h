// The normal of a surface that heights over (U,V) have raised (Blinn 1978): of the points p + h n. To first
// order in the slopes it is n less the gradient of h along the surface.
#pragma once
#include <Eigen/Core>

namespace bpms {

// `normal` is a unit vector; heights lie along it, on whichever side of the patch it is. dp_du, dp_dv (m)
// span the surface; slopes = (dh/dU, dh/dV) in metres, which is bump_m times those of the raster. Without an
// area to lie on the normal stays. The answer is a unit vector on the side of `normal`.
Eigen::Vector3f bumped_normal(const Eigen::Vector3f& normal, const Eigen::Vector3f& dp_du,
                              const Eigen::Vector3f& dp_dv, const Eigen::Vector2f& slopes);

}  // namespace bpms
