// An orthonormal frame about a unit vector (Duff et al. 2017, JCGT 6(1)), and directions in it.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bpms {

struct Basis {
  Eigen::Vector3f tangent, bitangent, normal;
  explicit Basis(const Eigen::Vector3f& n) : normal(n) {
    const float sign = std::copysign(1.0f, n.z());
    const float a = -1.0f / (sign + n.z());
    const float b = n.x() * n.y() * a;
    tangent = {1.0f + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
    bitangent = {b, sign + n.y() * n.y() * a, -n.y()};
  }
  Eigen::Vector3f to_local(const Eigen::Vector3f& v) const {
    return {tangent.dot(v), bitangent.dot(v), normal.dot(v)};
  }
  Eigen::Vector3f to_world(const Eigen::Vector3f& v) const {
    return v.x() * tangent + v.y() * bitangent + v.z() * normal;
  }
};

// About `normal` with density cos/pi.
inline Eigen::Vector3f cosine_direction(const Eigen::Vector3f& normal, double u, double v) {
  const auto radius = static_cast<float>(std::sqrt(u));
  const auto angle = static_cast<float>(2.0 * std::numbers::pi * v);
  const auto z = static_cast<float>(std::sqrt(1.0 - u));
  return Basis(normal).to_world({radius * std::cos(angle), radius * std::sin(angle), z}).normalized();
}

// Evenly over the cap of directions within acos(cos_radius) of the frame's normal.
inline Eigen::Vector3f even_in_cap(const Basis& frame, double cos_radius, double u, double v) {
  const double z = 1 - u * (1 - cos_radius), angle = 2.0 * std::numbers::pi * v;
  const double radius = std::sqrt(std::max(0.0, 1 - z * z));
  return frame.to_world(Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z).cast<float>())
      .normalized();
}

}  // namespace bpms
