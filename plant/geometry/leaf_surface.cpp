#include "plant/geometry/leaf_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "plant/geometry/frame_rate.h"
#include "plant/geometry/gauss_legendre.h"
#include "plant/leaf_frame.h"
#include "plant/plant_mesh.h"

namespace bpms {
namespace {

constexpr double small = 1e-4;  // below it the series are exact to double precision

// sin(x) / x and (1 - cos x) / x with their derivatives.
double sinc(double x) {
  return std::abs(x) < small ? 1 - x * x / 6 : std::sin(x) / x;
}
double sinc_rate(double x) {
  return std::abs(x) < small ? -x / 3 : (x * std::cos(x) - std::sin(x)) / (x * x);
}
double cosc(double x) {
  return std::abs(x) < small ? x / 2 : 2 * std::pow(std::sin(x / 2), 2) / x;
}
double cosc_rate(double x) {
  return std::abs(x) < small ? 0.5 - x * x / 8
                             : (x * std::sin(x) - 2 * std::pow(std::sin(x / 2), 2)) / (x * x);
}

}  // namespace

Eigen::Vector3d frame_rate(const OrganAttributes& organ, double l) {
  const auto value = [l](const std::unique_ptr<OrganFunction>& f) { return f ? f->value(l) : 0.0; };
  const auto rate = [l](const std::unique_ptr<OrganFunction>& f) { return f ? f->derivative(l) : 0.0; };
  const double azimuth = value(organ.f_azimuth);
  const double twist = value(organ.f_twist);
  const Eigen::Matrix3d from_azimuth = organ_rotation(0, azimuth, 0).transpose();
  const Eigen::Matrix3d from_twist = organ_rotation(0, 0, twist).transpose();
  return from_twist * (from_azimuth * Eigen::Vector3d(0, rate(organ.f_inclination), 0) +
                       Eigen::Vector3d(rate(organ.f_azimuth), 0, 0)) +
         Eigen::Vector3d(0, 0, rate(organ.f_twist));
}

std::vector<LeafRow> leaf_rows(const OrganAttributes& leaf, const std::vector<double>& l) {
  std::vector<LeafRow> out;
  out.reserve(l.size());
  for (const MidribPoint& point : midrib(leaf, l)) {
    LeafRow row;
    row.l = point.l;
    row.midrib_m = point.x_m;
    row.frame = point.frame;
    row.rate = frame_rate(leaf, point.l);
    row.length_m = leaf.length_m;
    const double fraction = leaf.f_width ? leaf.f_width->value(point.l) : 1.0;
    row.width_m = leaf.width_m * std::max(0.0, fraction);
    row.width_rate_m = fraction > 0 && leaf.f_width ? leaf.width_m * leaf.f_width->derivative(point.l) : 0.0;
    if (leaf.f_curvature) {
      row.half_angle = leaf.f_curvature->value(point.l);
      row.half_angle_rate = leaf.f_curvature->derivative(point.l);
    }
    out.push_back(row);
  }
  return out;
}

Eigen::Vector3d leaf_section_m(const LeafRow& row, double s) {
  const double angle = row.half_angle * s;
  const double v = row.width_m / 2 * s;
  return {-v * cosc(angle), v * sinc(angle), 0};
}

Eigen::Vector3d leaf_point_m(const LeafRow& row, double s) {
  return row.midrib_m + row.frame * leaf_section_m(row, s);
}

Eigen::Vector3d leaf_derivative_m(const LeafRow& row, double s) {
  const double angle = row.half_angle * s;
  const double angle_rate = row.half_angle_rate * s;
  const double v = row.width_m / 2 * s;
  const double v_rate = row.width_rate_m / 2 * s;
  const Eigen::Vector3d section = leaf_section_m(row, s);
  const Eigen::Vector3d section_rate(-v_rate * cosc(angle) - v * cosc_rate(angle) * angle_rate,
                                     v_rate * sinc(angle) + v * sinc_rate(angle) * angle_rate, 0);
  return row.frame * (Eigen::Vector3d(0, 0, row.length_m) + row.rate.cross(section) + section_rate);
}

Eigen::Vector3d leaf_across(const LeafRow& row, double s) {
  const double angle = row.half_angle * s;
  return row.frame * Eigen::Vector3d(-std::sin(angle), std::cos(angle), 0);
}

Eigen::Vector3d leaf_normal(const LeafRow& row, double s) {
  const Eigen::Vector3d normal = leaf_derivative_m(row, s).cross(leaf_across(row, s));
  if (normal.norm() > 1e-9 * row.length_m) return normal.normalized();
  return row.frame.col(2).cross(leaf_across(row, s));
}

double leaf_surface_area_m2(const OrganAttributes& leaf) {
  constexpr int panels = 16;  // between two kinks
  std::vector<double> ends{0};
  for (const double l : organ_breaks(leaf)) ends.push_back(l);
  ends.push_back(1);
  double area = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    std::vector<double> l, weights;
    const double panel = (ends[i + 1] - ends[i]) / panels;
    for (int p = 0; p < panels; ++p) {
      for (const GaussNode& node : gauss_legendre_8) {
        l.push_back(ends[i] + panel * (p + (1 + node.x) / 2));
        weights.push_back(panel / 2 * node.weight);
      }
    }
    const std::vector<LeafRow> rows = leaf_rows(leaf, l);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      for (const GaussNode& node : gauss_legendre_8) {
        const double element = leaf_derivative_m(rows[k], node.x).cross(leaf_across(rows[k], node.x)).norm();
        area += weights[k] * node.weight * element * rows[k].width_m / 2;
      }
    }
  }
  return area;
}

}  // namespace bpms
