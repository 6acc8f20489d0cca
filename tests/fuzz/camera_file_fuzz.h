// What every camera that a reader accepts must be.
#pragma once
#include <cmath>
#include <cstdlib>

#include "calibrate/rig.h"

namespace bpms::fuzz {

inline void require_sound(const Camera& camera) {
  if (camera.width_px < 1 || camera.height_px < 1) std::abort();
  if (parameter_names(camera).size() != camera.parameters.size() + 6) std::abort();
  for (const double p : camera.parameters)
    if (!std::isfinite(p)) std::abort();
  if (!(camera.parameters[0] > 0) || !(camera.parameters[1] > 0)) std::abort();
  if (!camera.t_cam_from_rig_m.allFinite()) std::abort();
  const Eigen::Matrix3d& r = camera.r_cam_from_rig;
  if (!((r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-5)) std::abort();
  const auto pixel = project(camera, {0.01, -0.02, 1});
  if (pixel && !pixel->allFinite()) std::abort();
}

}  // namespace bpms::fuzz
