#include "plant/geometry/subdivide.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/units.h"
#include "plant/leaf_frame.h"

namespace bpms {

namespace {

// Puts a node exactly there, in the place of one that is too near.
void require_node(std::vector<double>& nodes, double l, double least_gap) {
  const auto after = std::ranges::upper_bound(nodes, l);
  if (after == nodes.begin() || after == nodes.end()) return;
  for (const auto& near : {after - 1, after}) {
    const bool inner = near != nodes.begin() && near + 1 != nodes.end();
    if (std::abs(*near - l) > least_gap || (!inner && *near != l)) continue;
    *near = l;
    return;
  }
  nodes.insert(after, l);
}

}  // namespace

std::vector<double> first_nodes(const OrganAttributes& organ, double least_gap) {
  int steps = 1;
  for (const auto* function :
       {&organ.f_inclination, &organ.f_azimuth, &organ.f_twist, &organ.f_curvature, &organ.f_width}) {
    if (*function && (*function)->breaks().empty()) steps = std::max({steps, 4, (*function)->coefficients()});
  }
  std::vector<double> wanted = organ_breaks(organ);
  for (int i = 1; i < steps; ++i) wanted.push_back(static_cast<double>(i) / steps);
  std::ranges::sort(wanted);
  std::vector<double> out{0};
  for (const double l : wanted) {
    if (l - out.back() > least_gap && 1 - l > least_gap) out.push_back(l);
  }
  out.push_back(1);
  if (organ.senescent > 0) require_node(out, 1 - organ.senescent, least_gap);
  return out;
}

std::vector<double> with_quarters(const std::vector<double>& nodes) {
  constexpr int inner = 4;
  std::vector<double> out;
  out.reserve(inner * nodes.size());
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
    for (int k = 0; k < inner; ++k) out.push_back(nodes[i] + (nodes[i + 1] - nodes[i]) * k / inner);
  out.push_back(nodes.back());
  return out;
}

double distance_from_line(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length = along.norm();
  if (length < 1e-12) return (point - a).norm();
  return (point - a).cross(along).norm() / length;
}

int circle_sides(double radius_m, double tolerance_m, int least, int most) {
  const double sagitta = std::min(1.0, tolerance_m / std::max(radius_m, 1e-9));
  // Within bounds before it is a whole number: of a circle without end it is infinite.
  return static_cast<int>(std::clamp(std::ceil(pi / std::acos(1 - sagitta)), 1.0 * least, 1.0 * most));
}

}  // namespace bpms
