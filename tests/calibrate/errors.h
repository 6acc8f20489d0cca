// Estimated minus true parameters of a rig.
#pragma once
#include <vector>

#include "calibrate/pose.h"
#include "calibrate/rig.h"

namespace bpms::test {

// In the order of the covariance: rotations as left perturbations.
inline Eigen::VectorXd errors(const std::vector<Camera>& estimate, const std::vector<Camera>& truth) {
  std::vector<double> out;
  for (std::size_t c = 0; c < truth.size(); ++c) {
    for (std::size_t i = 0; i < truth[c].parameters.size(); ++i)
      out.push_back(estimate[c].parameters[i] - truth[c].parameters[i]);
    if (c == 0) continue;
    const Eigen::Vector3d turn =
        vector_from_rotation(estimate[c].r_cam_from_rig * truth[c].r_cam_from_rig.transpose());
    const Eigen::Vector3d shift = estimate[c].t_cam_from_rig_m - truth[c].t_cam_from_rig_m;
    out.insert(out.end(), turn.begin(), turn.end());
    out.insert(out.end(), shift.begin(), shift.end());
  }
  return Eigen::Map<Eigen::VectorXd>(out.data(), static_cast<Eigen::Index>(out.size()));
}

}  // namespace bpms::test
