// A circle in space through points with covariances: the rim of a plant pot gives the horizontal and a scale
// check.
//
// Model: x_i = c + R (cos f_i e1 + sin f_i e2) + error_i, error_i ~ N(0, C_i + s^2 I); unknown c, the normal
// n = e1 x e2, R and the angles f_i (eliminated point by point). Maximum likelihood by Levenberg-Marquardt
// from the least-squares plane and Kasa's circle in it. The chi-square has 3N - N - 6 = 2N - 6 degrees of
// freedom. s is how far the real rim is off a circle: 0 while chi-square <= dof, else what makes them equal
// (the estimator of Mandel & Paule 1970). Without it, points whose depth is known ten times worse than their
// height would tie the circle to every dent. Rig errors are common to all points: they are propagated as such
// and do not average out.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "reconstruct/reconstruct.h"

namespace bpms {

struct Rim {
  Eigen::Vector3d centre_m;
  Eigen::Vector3d normal;  // unit, towards `towards`
  double diameter_m = 0;
  double diameter_sigma_m = 0;
  double normal_sigma_rad = 0;  // root of the sum of the two variances of its direction
  double tilt_rad = 0;          // between the normal and `towards`
  double plane_rms_m = 0;       // of the points' distances from the circle's plane
  double roughness_m = 0;       // s
  double chi2 = 0;              // with s
  int dof = 0;
  int points = 0;
};

// `rig_covariance` may be empty. Fewer than 4 points are bad input; an arc too short to tell the circle is a
// numeric error.
Rim fit_rim(const std::vector<const ReconstructedPoint*>& points, const Eigen::MatrixXd& rig_covariance,
            const Eigen::Vector3d& towards);

// The accepted points labelled organ "pot", feature "outline".
std::vector<const ReconstructedPoint*> pot_outline(const Vectors& vectors);

}  // namespace bpms
