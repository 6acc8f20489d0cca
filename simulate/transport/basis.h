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

// Sine and cosine of 2 pi v, 0 <= v < 1, to float rounding: a call of the library's takes longer than all
// else that a direction needs.
inline void sine_cosine_of_turn(float v, float& sine, float& cosine) {
  const float quarters = 4 * v;
  const int whole = static_cast<int>(quarters + 0.5f);
  const float x = (quarters - static_cast<float>(whole)) * (std::numbers::pi_v<float> / 2), x2 = x * x;
  const float s = x * (1 + x2 * (-1.0f / 6 + x2 * (1.0f / 120 + x2 * (-1.0f / 5040 + x2 * (1.0f / 362880)))));
  const float c = 1 + x2 * (-0.5f + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 * (1.0f / 40320))));
  const float a = (whole & 1) != 0 ? c : s, b = (whole & 1) != 0 ? s : c;
  sine = (whole & 2) != 0 ? -a : a;
  cosine = ((whole + 1) & 2) != 0 ? -b : b;
}

// About `normal` with density cos/pi.
inline Eigen::Vector3f cosine_direction(const Eigen::Vector3f& normal, double u, double v) {
  const auto u_f = static_cast<float>(u);
  const float radius = std::sqrt(u_f), z = static_cast<float>(std::sqrt(1.0 - u));
  float sine = 0, cosine = 0;
  sine_cosine_of_turn(static_cast<float>(v), sine, cosine);
  return Basis(normal).to_world({radius * cosine, radius * sine, z});
}

// Evenly over the cap of directions within acos(cos_radius) of the frame's normal.
inline Eigen::Vector3f even_in_cap(const Basis& frame, double cos_radius, double u, double v) {
  const double z = 1 - u * (1 - cos_radius), angle = 2.0 * std::numbers::pi * v;
  const double radius = std::sqrt(std::max(0.0, 1 - z * z));
  return frame.to_world(Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z).cast<float>())
      .normalized();
}

}  // namespace bpms
