// A rotation in space, right-handed, as a unit quaternion in floats: 16 bytes, since a scene may hold
// millions of them. Applied in double precision; a rotation of floats is off by up to 1e-7 radians.
#pragma once
#include <Eigen/Geometry>
#include <cmath>

namespace bpms {

class Rotation {
 public:
  Rotation() = default;
  // What stands upright is turned by one angle about z, counter-clockwise seen from above.
  Rotation(double about_z)
      : z_(static_cast<float>(std::sin(0.5 * about_z))), w_(static_cast<float>(std::cos(0.5 * about_z))) {}
  explicit Rotation(const Eigen::Quaterniond& q) {
    const Eigen::Quaternionf unit = q.normalized().cast<float>();
    x_ = unit.x(), y_ = unit.y(), z_ = unit.z(), w_ = unit.w();
  }
  // About x first, then y, then z, all of them fixed axes.
  static Rotation about_axes(double z, double y, double x) {
    return Rotation(Eigen::AngleAxisd(z, Eigen::Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(y, Eigen::Vector3d::UnitY()) *
                    Eigen::AngleAxisd(x, Eigen::Vector3d::UnitX()));
  }

  Eigen::Vector3d operator*(const Eigen::Vector3d& v) const { return turn(v, 1); }
  Eigen::Vector3d back(const Eigen::Vector3d& v) const { return turn(v, -1); }  // the inverse
  Eigen::Quaterniond quaternion() const { return Eigen::Quaterniond(w_, x_, y_, z_).normalized(); }
  Eigen::Matrix3d matrix() const { return quaternion().toRotationMatrix(); }
  bool upright() const { return x_ == 0 && y_ == 0; }

 private:
  Eigen::Vector3d turn(const Eigen::Vector3d& v, double way) const {
    if (upright()) {  // most are
      const double z = z_, sine = way * 2 * z * w_, cosine = 1 - 2 * z * z;
      return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y(), v.z()};
    }
    const Eigen::Vector3d axis(way * x_, way * y_, way * z_);
    const Eigen::Vector3d t = 2 * axis.cross(v);
    return v + w_ * t + axis.cross(t);
  }
  float x_ = 0, y_ = 0, z_ = 0, w_ = 1;
};

}  // namespace bpms
