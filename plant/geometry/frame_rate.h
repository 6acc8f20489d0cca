// How fast an organ's frame turns along l.
#pragma once
#include <Eigen/Core>

#include "plant/plant.h"

namespace bpms {
// Angular velocity per l of Ry(inclination) Rx(azimuth) Rz(twist), in the frame itself.
Eigen::Vector3d frame_rate(const OrganAttributes& organ, double l);
}  // namespace bpms
