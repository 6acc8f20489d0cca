// From the lens of a first guess to the lens asked for: the new one's parameters that send the old one's
// rays, over the image, to the old one's pixels (least squares).
#pragma once
#include "calibrate/lenses/lens.h"
#include "calibrate/rig.h"

namespace bpms {

// A longer model of the same kind starts with zeros. numeric error when the new model cannot follow.
Camera enriched(const Camera& camera, const LensChoice& choice);

}  // namespace bpms
