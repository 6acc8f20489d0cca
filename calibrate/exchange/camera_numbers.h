// What all readers of camera files require of a camera.
#pragma once
#include "calibrate/pose.h"
#include "calibrate/rig.h"

namespace bpms {

inline constexpr long long largest_camera_image_px = 1'000'000;
inline constexpr double largest_camera_number = 1e12;  // a parameter or a length beyond it is no measurement

// bad_input: an image without size, focal lengths that are not positive, numbers that are not finite, a lens
// model that is not there or has another number of parameters.
void require_sound_numbers(const Camera& camera, const SourceLocation& where);
void require_sound_size(const Camera& camera, const SourceLocation& where);
// The nearest rotation of a matrix from a file; bad_input where it is none within the digits files are
// written with.
Eigen::Matrix3d sound_rotation(const Eigen::Matrix3d& r, const SourceLocation& where);
// Of a quaternion w x y z (Hamilton), which files hold rounded.
Eigen::Matrix3d sound_rotation(const Eigen::Vector4d& wxyz, const SourceLocation& where);
// No coordinate is NaN, infinite or beyond largest_camera_number.
template <class Vector>
bool is_sound_vector(const Vector& x) {
  return x.allFinite() && x.cwiseAbs().maxCoeff() <= largest_camera_number;
}
// w >= 0.
Eigen::Vector4d quaternion_wxyz(const Eigen::Matrix3d& r);

}  // namespace bpms
