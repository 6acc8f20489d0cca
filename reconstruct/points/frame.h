// The frame that the vectors are written in: x_out = R (x_rig - origin). Identity unless asked for, because
// the rig knows neither which way is up nor where the plant begins. Upright: +z is the given direction; +x is
// the rig's x axis made horizontal (its z axis where x is within 10 degrees of the vertical); +y completes
// the right-handed frame. So the azimuth is the rig's, not north's. A covariance turns with R and is not
// enlarged: the frame is a choice, fixed in the rig's frame; errors of that choice are reported apart.
#pragma once
#include <Eigen/Core>
#include <string>

#include "reconstruct/reconstruct.h"

namespace bpms {

struct Frame {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // out from rig
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();      // in the rig's frame

  Eigen::Vector3d point(const Eigen::Vector3d& x_rig) const { return rotation * (x_rig - origin_m); }
  Eigen::Matrix3d covariance(const Eigen::Matrix3d& c) const { return rotation * c * rotation.transpose(); }
  VectorPoint operator()(VectorPoint p) const;
};

// The rotation of the upright frame; `up` has any length but zero.
Eigen::Matrix3d upright(const Eigen::Vector3d& up);

// The direction opposite to the images' y axes, averaged over the cameras: up for a rig held level.
Eigen::Vector3d image_up(const Rig& rig);

// The one accepted point that fits "organ=bud" or "plant=1,organ=stem,feature=axis,point=0" (keys: plant,
// axis, rank, organ, feature, point). None, or several, is bad input that says which.
Eigen::Vector3d labelled_origin(const std::string& conditions, const Vectors& vectors);

}  // namespace bpms
