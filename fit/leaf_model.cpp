#include "fit/leaf_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace bpms {
namespace {

using Basis = std::array<double, most_coefficients>;

// Twelve panels of a six-point rule: error below 1e-12 of the length for angles that turn by a few radians.
std::vector<double> panels(const LeafModelShape& shape) {
  constexpr int uniform = 12;
  std::vector<double> ends = shape.inclination.breaks();
  for (const double b : shape.azimuth.breaks()) ends.push_back(b);
  for (int i = 0; i <= uniform; ++i) ends.push_back(static_cast<double>(i) / uniform);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end(), [](double a, double b) { return b - a < 1e-9; }),
             ends.end());
  ends.back() = 1.0;
  return ends;
}

double dot(const double* phi, const Eigen::VectorXd& parameters, int at, int size) {
  double sum = 0;
  for (int k = 0; k < size; ++k) sum += phi[k] * parameters[at + k];
  return sum;
}

}  // namespace

LeafModel::LeafModel(LeafModelShape shape) : shape_(std::move(shape)) {
  at_width_ = at_twist() + shape_.twist.size();
  ends_ = panels(shape_);
  const auto nodes = static_cast<Eigen::Index>((ends_.size() - 1) * gauss_points);
  table_i_.resize(shape_.inclination.size(), nodes);
  table_a_.resize(shape_.azimuth.size(), nodes);
  for (std::size_t p = 0; p + 1 < ends_.size(); ++p) {
    for (int g = 0; g < gauss_points; ++g) {
      const double l = ends_[p] + (ends_[p + 1] - ends_[p]) * gauss_node[g];
      const Eigen::Index column = static_cast<Eigen::Index>(p) * gauss_points + g;
      shape_.inclination.values(l, table_i_.col(column).data());
      shape_.azimuth.values(l, table_a_.col(column).data());
    }
  }
}

LeafModel::Angles LeafModel::angles(const double* phi_i, const double* phi_a) const {
  const double i = dot(phi_i, parameters_, at_inclination(), shape_.inclination.size());
  const double a = dot(phi_a, parameters_, at_azimuth(), shape_.azimuth.size());
  return {std::sin(i), std::cos(i), std::sin(a), std::cos(a)};
}

void LeafModel::add_node(const double* phi_i, const double* phi_a, double weight, bool with_derivatives,
                         Integral& sum) const {
  const auto [si, ci, sa, ca] = angles(phi_i, phi_a);
  sum.col(0) += weight * Eigen::Vector3d(ca * si, -sa, ca * ci);
  if (!with_derivatives) return;
  const int ni = shape_.inclination.size(), na = shape_.azimuth.size();
  const Eigen::Vector3d by_i = weight * Eigen::Vector3d(ca * ci, 0, -ca * si);
  const Eigen::Vector3d by_a = weight * Eigen::Vector3d(-sa * si, -ca, -sa * ci);
  for (int k = 0; k < ni; ++k) sum.col(1 + k) += phi_i[k] * by_i;
  for (int k = 0; k < na; ++k) sum.col(1 + ni + k) += phi_a[k] * by_a;
}

void LeafModel::set(const Eigen::VectorXd& parameters, bool with_derivatives) {
  parameters_ = parameters;
  const int columns = 1 + shape_.inclination.size() + shape_.azimuth.size();
  at_end_.assign(ends_.size(), Integral::Zero(3, columns));
  for (std::size_t p = 0; p + 1 < ends_.size(); ++p) {
    at_end_[p + 1] = at_end_[p];
    for (int g = 0; g < gauss_points; ++g) {
      const Eigen::Index column = static_cast<Eigen::Index>(p) * gauss_points + g;
      add_node(table_i_.col(column).data(), table_a_.col(column).data(),
               (ends_[p + 1] - ends_[p]) * gauss_weight[g], with_derivatives, at_end_[p + 1]);
    }
  }
}

Eigen::Vector3d LeafModel::edge_offset(double l, double side,
                                       Eigen::Matrix<double, 3, 4>* derivatives) const {
  Basis phi;
  shape_.inclination.values(l, phi.data());
  const double i = dot(phi.data(), parameters_, at_inclination(), shape_.inclination.size());
  shape_.azimuth.values(l, phi.data());
  const double a = dot(phi.data(), parameters_, at_azimuth(), shape_.azimuth.size());
  shape_.twist.values(l, phi.data());
  const double t = dot(phi.data(), parameters_, at_twist(), shape_.twist.size());
  shape_.width.values(l, phi.data());
  const double w = dot(phi.data(), parameters_, at_width(), shape_.width.size());
  const double si = std::sin(i), ci = std::cos(i), sa = std::sin(a), ca = std::cos(a), st = std::sin(t),
               ct = std::cos(t);
  // Columns of Ry(i) Rx(a): x0, y0, z0; y turned by the twist is ct y0 - st x0.
  const Eigen::Vector3d x0(ci, 0, -si), y0(si * sa, ca, ci * sa), z0(si * ca, -sa, ci * ca);
  const Eigen::Vector3d y = ct * y0 - st * x0;
  const double half = side * w / 2;
  if (derivatives != nullptr) {
    derivatives->col(0) =
        half * (ct * Eigen::Vector3d(ci * sa, 0, -si * sa) - st * Eigen::Vector3d(-si, 0, -ci));
    derivatives->col(1) = half * ct * z0;
    derivatives->col(2) = half * (-st * y0 - ct * x0);
    derivatives->col(3) = side / 2 * y;
  }
  return half * y;
}

Eigen::Matrix3d LeafModel::frame(double l) const {
  Basis phi_i, phi_a;
  shape_.inclination.values(l, phi_i.data());
  shape_.azimuth.values(l, phi_a.data());
  const auto [si, ci, sa, ca] = angles(phi_i.data(), phi_a.data());
  Eigen::Matrix3d out;
  out << ci, si * sa, si * ca, 0, ca, -sa, -si, ci * sa, ci * ca;
  const double direction = shape_.direction_free ? parameters_[at_direction()] : shape_.direction;
  return Eigen::AngleAxisd(direction, Eigen::Vector3d::UnitZ()).toRotationMatrix() * out;
}

void LeafModel::point(LeafCurve curve, double l, bool with_derivatives, Point& out) const {
  const auto upper = std::upper_bound(ends_.begin(), ends_.end() - 1, l);
  const auto panel = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, upper - ends_.begin() - 1));
  Integral integral = at_end_[panel];
  Basis phi_i, phi_a;
  const double width = l - ends_[panel];
  if (width != 0) {
    for (int g = 0; g < gauss_points; ++g) {
      const double node = ends_[panel] + width * gauss_node[g];
      shape_.inclination.values(node, phi_i.data());
      shape_.azimuth.values(node, phi_a.data());
      add_node(phi_i.data(), phi_a.data(), width * gauss_weight[g], with_derivatives, integral);
    }
  }
  shape_.inclination.values(l, phi_i.data());
  shape_.azimuth.values(l, phi_a.data());
  const auto [si, ci, sa, ca] = angles(phi_i.data(), phi_a.data());
  const double length = parameters_[at_length()];
  Eigen::Vector3d local = length * integral.col(0);
  Eigen::Vector3d tangent = length * Eigen::Vector3d(ca * si, -sa, ca * ci);

  const double side = curve == LeafCurve::midrib ? 0.0 : curve == LeafCurve::edge_left ? 1.0 : -1.0;
  Eigen::Matrix<double, 3, 4> by_edge;
  if (side != 0) {
    local += edge_offset(l, side, with_derivatives ? &by_edge : nullptr);
    // The tangent only steers the search for the nearest point and the projection of derivatives.
    constexpr double step = 1e-5;
    const double low = std::max(0.0, l - step), high = std::min(1.0, l + step);
    tangent += (edge_offset(high, side, nullptr) - edge_offset(low, side, nullptr)) / (high - low);
  }

  const double direction = shape_.direction_free ? parameters_[at_direction()] : shape_.direction;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(direction, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  out.x = shape_.base + turn * local;
  for (std::size_t k = 0; k < shape_.base_axes.size(); ++k)
    out.x[shape_.base_axes[k]] += parameters_[at_base() + static_cast<int>(k)];
  out.tangent = turn * tangent;
  if (!with_derivatives) return;

  const int ni = shape_.inclination.size(), na = shape_.azimuth.size();
  out.jacobian.setZero(3, parameters());
  out.jacobian.col(at_length()) = turn * integral.col(0);
  const Eigen::Vector3d turned = turn * local;
  if (shape_.direction_free) out.jacobian.col(at_direction()) = Eigen::Vector3d(-turned.y(), turned.x(), 0);
  for (std::size_t k = 0; k < shape_.base_axes.size(); ++k)
    out.jacobian(shape_.base_axes[k], at_base() + static_cast<int>(k)) = 1;
  out.jacobian.middleCols(at_inclination(), ni) = length * turn * integral.middleCols(1, ni);
  out.jacobian.middleCols(at_azimuth(), na) = length * turn * integral.middleCols(1 + ni, na);
  if (side == 0) return;
  by_edge = turn * by_edge;
  for (int k = 0; k < ni; ++k)
    out.jacobian.col(at_inclination() + k) += phi_i[static_cast<std::size_t>(k)] * by_edge.col(0);
  for (int k = 0; k < na; ++k)
    out.jacobian.col(at_azimuth() + k) += phi_a[static_cast<std::size_t>(k)] * by_edge.col(1);
  Basis phi;
  shape_.twist.values(l, phi.data());
  for (int k = 0; k < shape_.twist.size(); ++k)
    out.jacobian.col(at_twist() + k) = phi[static_cast<std::size_t>(k)] * by_edge.col(2);
  shape_.width.values(l, phi.data());
  for (int k = 0; k < shape_.width.size(); ++k)
    out.jacobian.col(at_width() + k) = phi[static_cast<std::size_t>(k)] * by_edge.col(3);
}

}  // namespace bpms
