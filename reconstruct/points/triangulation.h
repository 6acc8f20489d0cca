// One 3-D point from its sightings: minimises sum |q_i - proj_i(X)|^2 / sigma_i^2 with the full camera
// models. Start: direct linear transform on the unit rays of the pixels (Hartley & Zisserman 2004, 12.2);
// then Gauss-Newton with step halving. Covariance of the observations alone: C = (sum J' S^-1 J)^-1.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "calibrate/rig.h"
#include "reconstruct/reconstruct.h"

namespace bpms {

struct Triangulation {
  std::string failure;                  // empty, or a reason of ReconstructedPoint
  Eigen::Vector3d x_m;                  // in the rig's frame
  Eigen::Matrix3d covariance_m2;        // of the observations alone
  Eigen::VectorXd residual;             // (q - proj)/sigma, 2 numbers a sighting
  Eigen::MatrixXd by_point;             // derivatives of proj/sigma by the point
  std::vector<Projection> projections;  // at the solution, one a sighting
};

Triangulation triangulate(const std::vector<Sighting>& sightings, const Rig& rig);

}  // namespace bpms
