// The parametric surface of a leaf: S(l, s), l along from base to tip, s across from -1 (V = 0) to 1 (V = 1),
// in proportion to the length across. What it looks like across is its section's business
// (sections/section.h).
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "plant/geometry/sections/section.h"
#include "plant/plant.h"

namespace bpms {

struct LeafRow {
  double l = 0;
  Eigen::Vector3d midrib_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();  // columns x y z
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();  // angular velocity of the frame per l, in the frame itself
  double length_m = 0;                             // of the whole leaf
  double width_m = 0, width_rate_m = 0;
  double half_angle_rate = 0;
  SectionForm form;
  const LeafSection* section = nullptr;
};
// At rising l.
std::vector<LeafRow> leaf_rows(const OrganAttributes& leaf, const std::vector<double>& l);
LeafRow leaf_row(const OrganAttributes& leaf, const LeafSection& section, double l,
                 const Eigen::Vector3d& midrib_m);

// The cross-section in the row's frame: (x, y, 0). All of these take the panel that s is on (its fold may be
// of two); without one, the panel is looked for.
Eigen::Vector3d leaf_section_m(const LeafRow& row, double s);
Eigen::Vector3d leaf_point_m(const LeafRow& row, double s);
Eigen::Vector3d leaf_point_m(const LeafRow& row, int panel, double s);
// Derivative by l, and the unit tangent across (defined where the width is zero, too).
Eigen::Vector3d leaf_derivative_m(const LeafRow& row, int panel, double s);
Eigen::Vector3d leaf_across(const LeafRow& row, int panel, double s);
Eigen::Vector3d leaf_normal(const LeafRow& row, int panel, double s);  // unit, towards the upper side
Eigen::Vector3d leaf_normal(const LeafRow& row, double s);

// Ends of the panels, -1 and 1 among them; `panel` of s (the later one at a fold).
std::vector<double> panel_ends(const OrganAttributes& leaf);
int panel_at(const LeafRow& row, double s);
// The area between rising places, without kinks between them.
double leaf_area_m2(const OrganAttributes& leaf, std::span<const double> ends);
// Places in (0, 1) where f_width goes through zero between these, rising.
std::vector<double> width_zeros(const OrganAttributes& leaf, std::span<const double> between);

}  // namespace bpms
