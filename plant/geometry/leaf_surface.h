// The parametric surface of a leaf: S(l, s), l along from base to tip, s across from -1 (V = 0) to 1 (V = 1).
// The cross-section is an arc of a circle of half-angle c = curvature(l): its length is the width, its middle
// lies on the midrib, and positive c lifts both edges towards the upper side (-x). Half-angle 180 degrees
// closes the circle.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "plant/plant.h"

namespace bpms {

struct LeafRow {
  double l = 0;
  Eigen::Vector3d midrib_m;
  Eigen::Matrix3d frame;  // columns x y z
  Eigen::Vector3d rate;   // angular velocity of the frame per l, in the frame itself
  double length_m = 0;    // of the whole leaf
  double width_m = 0, width_rate_m = 0;
  double half_angle = 0, half_angle_rate = 0;
};
std::vector<LeafRow> leaf_rows(const OrganAttributes& leaf, const std::vector<double>& l);

// The cross-section at s in the row's frame: (x, y, 0).
Eigen::Vector3d leaf_section_m(const LeafRow& row, double s);
Eigen::Vector3d leaf_point_m(const LeafRow& row, double s);
// Derivative by l, and the unit tangent across (defined where the width is zero, too).
Eigen::Vector3d leaf_derivative_m(const LeafRow& row, double s);
Eigen::Vector3d leaf_across(const LeafRow& row, double s);
Eigen::Vector3d leaf_normal(const LeafRow& row, double s);  // unit, towards the upper side

}  // namespace bpms
