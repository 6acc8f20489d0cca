// An organ's frame at l, how fast it turns there, and steps along the midrib.
#pragma once
#include <Eigen/Core>

#include "plant/plant.h"

namespace bpms {

// Angular velocity per l of Ry(inclination) Rx(azimuth) Rz(twist), in the frame itself.
Eigen::Vector3d frame_rate(const OrganAttributes& organ, double l);

struct MovingFrame {
  Eigen::Matrix3d frame;
  Eigen::Vector3d rate;
};
MovingFrame moving_frame(const OrganAttributes& organ, double l);

// The integral of the midrib's tangent between two places without a break between them, for a length of 1.
Eigen::Vector3d midrib_step(const OrganAttributes& organ, double from, double to);
// The same where the frame turns by little at the rate given: three nodes do then (1e-9).
Eigen::Vector3d short_midrib_step(const OrganAttributes& organ, double from, double to,
                                  const Eigen::Vector3d& rate);

}  // namespace bpms
