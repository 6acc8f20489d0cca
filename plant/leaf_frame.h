// The forward model of an organ's midrib, shared by the geometry and by the fit.
// frame(l) = base Ry(inclination(l)) Rx(azimuth(l)) Rz(twist(l)), right-handed, moving axes; its z axis is
// the tangent (cos a sin i, -sin a, cos a cos i). The midrib is L * integral of z (BPMS paper 2.1.3;
// docs/plant_language.md).
#pragma once
#include <Eigen/Core>
#include <vector>

#include "plant/plant.h"

namespace bpms {

// The rotation Ry(i) Rx(a) Rz(t); columns x (downward-facing side), y (across), z (along).
Eigen::Matrix3d organ_rotation(double inclination, double azimuth, double twist);

// The frame at l in the organ's own frame: the rotation by the functions (absent = 0), without the constants
// a_.
Eigen::Matrix3d organ_frame(const OrganAttributes& organ, double l);
// Places in (0, 1) where one of the organ's functions may have a kink, rising.
std::vector<double> organ_breaks(const OrganAttributes& organ);

struct MidribPoint {
  double l = 0;
  Eigen::Vector3d x_m;    // in the organ's frame, base at the origin
  Eigen::Matrix3d frame;  // columns x y z in the organ's frame
};
// The integrated midrib at the given rising l values, Gauss-Legendre between them and the functions' breaks;
// error below 1e-9 of the length for the functions of the language.
std::vector<MidribPoint> midrib(const OrganAttributes& organ, const std::vector<double>& l);

}  // namespace bpms
