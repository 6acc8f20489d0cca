// How sure the projection of a camera is, pixel by pixel, at a given range; and how far two calibrations of
// one camera differ. A lens and the place of its camera trade against each other, so both are told after the
// small rigid motion of the camera that makes the change least has been taken off (the idea of mrcal's
// projection uncertainty; here the motion is fitted in closed form): least over a region, where corners were
// seen, since beyond it the lens is an extrapolation.
#pragma once
#include <optional>
#include <vector>

#include "calibrate/rig.h"

namespace bpms {

struct ProjectionMap {
  double range_m = 0;  // distance of the points from the camera; 0: infinitely far, where only turns count
  int columns = 0, rows = 0;
  std::vector<double> x_px, y_px;  // of the columns, of the rows
  // Row by row; not a number where the lens has no ray. Of an uncertainty: the larger standard deviation of
  // the two axes of the error ellipse. Of a difference: its length.
  std::vector<double> px;
  double quantile(double q) const;  // of those that are numbers
};

struct MapOptions {
  double range_m = 1;
  int columns = 32, rows = 24;
  std::vector<Eigen::Vector2d> region = {};  // convex (valid_region.h); empty: the whole image
};
// From the covariance of the lens parameters (in the order of Camera::parameters; those not estimated have
// zeros).
ProjectionMap projection_uncertainty(const Camera& camera, const Eigen::MatrixXd& lens_covariance,
                                     const MapOptions& options = {});
// The block of a rig's covariance that belongs to a camera's lens.
Eigen::MatrixXd lens_covariance(const Rig::Covariance& covariance, const Camera& camera);

// How far apart the two put the points that lie along the pixels of the first.
ProjectionMap projection_difference(const Camera& camera, const Camera& other,
                                    const MapOptions& options = {});

}  // namespace bpms
