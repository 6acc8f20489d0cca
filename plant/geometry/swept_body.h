// Stems, heads and buds: a circle swept along the organ's midrib.
// A stem's radius is a_radius * f_width(l), its ends are flat. A bud is the sphere of a_radius; a head
// without f_width is the spheroid of a_length and a_radius bent along its midrib; with f_width it is like a
// stem.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "plant/plant.h"

namespace bpms {

struct SweptBody {
  const OrganAttributes* organ = nullptr;
  double length_m = 0;
  bool rounded = false;  // a spheroid bent along the midrib

  bool empty() const { return length_m <= 0 || organ->radius_m <= 0; }
  bool is_straight() const { return !organ->f_inclination && !organ->f_azimuth; }
  double point_below_m() const {
    return std::max(1e-5 * organ->radius_m, 1e-7);
  }  // a ring as good as a point
};
SweptBody swept_body(OrganKind kind, const OrganAttributes& organ);

// A ring of the body. The parameter u runs over [0, 1]; rounded bodies use l = (1 - cos(pi u)) / 2, radius ~
// sin(pi u), whose rows crowd towards the poles, elsewhere l = u.
struct Ring {
  double u = 0, l = 0;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();  // of the frame, by l
  double radius_m = 0;
  double l_rate = 0, radius_rate_m = 0;  // by u
};
std::vector<Ring> rings(const SweptBody& body, const std::vector<double>& u);  // at rising u
// Rings that frusta between them stay within the tolerance of the body.
std::vector<Ring> ring_nodes(const SweptBody& body, double tolerance_m);

struct MassProperties {
  double area_m2 = 0;  // of the whole surface
  double volume_m3 = 0;
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();  // of the volume, in the organ's frame
};
// By quadrature over the body, exact as long as it does not cut into itself where it bends.
MassProperties swept_mass(const SweptBody& body);
// With the sphere at a stem's tip: all its surface counts, and its volume is that which is not in the stem
// (taken as a straight cylinder there).
MassProperties organ_mass(OrganKind kind, const OrganAttributes& organ);

// The radius of the sphere at the tip, 0: none.
double joint_radius_m(const OrganAttributes& stem);

}  // namespace bpms
