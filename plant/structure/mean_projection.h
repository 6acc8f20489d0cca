// The projection of a unit of leaf area on the plane normal to a direction, averaged over the leaf's azimuth
// (Warren Wilson 1960): what G is made of.
#pragma once

namespace bpms {
// |n . Omega| for a leaf inclination (zenith of its normal) and a direction's zenith, radians.
double mean_projection(double leaf_angle, double zenith);
}  // namespace bpms
