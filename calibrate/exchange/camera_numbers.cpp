#include "calibrate/exchange/camera_numbers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "calibrate/lenses/lens.h"

namespace bpms {

void require_sound_numbers(const Camera& camera, const SourceLocation& where) {
  for (const double p : camera.parameters) {
    if (!(std::abs(p) <= largest_camera_number))
      bad_input(where, "a parameter of the camera is {:.6g}, expected a finite number below 1e12", p);
  }
  const Lens* lens = find_lens(camera.model);
  if (lens == nullptr) bad_input(where, "this version of bpms has no lens model {}", camera.model);
  if (lens->parameter_names({camera.parameters, camera.constants}).empty())
    bad_input(where, "{} parameters of the lens {}; expected {}", camera.parameters.size(), camera.model,
              lens->expected_numbers());
  if (!(camera.parameters[0] > 0) || !(camera.parameters[1] > 0))
    bad_input(where, "focal lengths {:.6g} and {:.6g}, expected positive ones in pixels",
              camera.parameters[0], camera.parameters[1]);
}

void require_sound_size(const Camera& camera, const SourceLocation& where) {
  const auto sound = [](int size) { return size >= 1 && size <= largest_camera_image_px; };
  if (!sound(camera.width_px) || !sound(camera.height_px))
    bad_input(where, "an image of {}x{} pixels, expected 1 to 1000000 each way", camera.width_px,
              camera.height_px);
}

Eigen::Matrix3d sound_rotation(const Eigen::Matrix3d& r, const SourceLocation& where) {
  constexpr double digits = 1e-4;  // some tools print six digits, others read them as floats
  const double off = (r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!r.allFinite() || !(off < digits))
    bad_input(where, "the matrix is no rotation: its rows are off orthonormal by {:.3g}", off);
  if (r.determinant() < 0) bad_input(where, "the matrix is a reflection (determinant -1), not a rotation");
  return orthonormalised(r);
}

Eigen::Matrix3d sound_rotation(const Eigen::Vector4d& wxyz, const SourceLocation& where) {
  constexpr double digits = 1e-3;
  if (!(std::abs(wxyz.norm() - 1) < digits))
    bad_input(where, "the quaternion has length {:.6g}, expected 1 (w x y z)", wxyz.norm());
  return Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized().toRotationMatrix();
}

Eigen::Vector4d quaternion_wxyz(const Eigen::Matrix3d& r) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(r).normalized();
  const Eigen::Vector4d out(q.w(), q.x(), q.y(), q.z());
  return out[0] < 0 ? Eigen::Vector4d(-out) : out;
}

}  // namespace bpms
