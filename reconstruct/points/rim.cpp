#include "reconstruct/points/rim.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace bpms {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;  // centre, two turns of the normal (about -e2, e1), radius
using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct Circle {
  Eigen::Vector3d centre, e1, e2;
  double radius = 0;
  std::vector<double> angle;
  Eigen::Vector3d normal() const { return e1.cross(e2); }
  Eigen::Vector3d direction(std::size_t i) const { return std::cos(angle[i]) * e1 + std::sin(angle[i]) * e2; }
  Eigen::Vector3d tangent(std::size_t i) const { return -std::sin(angle[i]) * e1 + std::cos(angle[i]) * e2; }
};

struct Data {
  std::vector<Eigen::Vector3d> x;
  std::vector<Eigen::Matrix3d> whitener;  // L^-1 of C = L L'
};

Circle start(const Data& data) {
  const auto count = static_cast<double>(data.x.size());
  Circle out;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& x : data.x) mean += x / count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& x : data.x) scatter += (x - mean) * (x - mean).transpose();
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors();
  out.e1 = axes.col(2);
  out.e2 = axes.col(1);
  // Kasa: 2 a x + 2 b y + c = x^2 + y^2 in the plane's coordinates.
  Eigen::MatrixXd rows(data.x.size(), 3);
  Eigen::VectorXd right(data.x.size());
  for (std::size_t i = 0; i < data.x.size(); ++i) {
    const double a = out.e1.dot(data.x[i] - mean), b = out.e2.dot(data.x[i] - mean);
    rows.row(static_cast<Eigen::Index>(i)) << 2 * a, 2 * b, 1;
    right[static_cast<Eigen::Index>(i)] = a * a + b * b;
  }
  const Eigen::Vector3d kasa = rows.colPivHouseholderQr().solve(right);
  out.centre = mean + kasa[0] * out.e1 + kasa[1] * out.e2;
  out.radius = std::sqrt(std::max(0.0, kasa[2] + kasa[0] * kasa[0] + kasa[1] * kasa[1]));
  for (const auto& x : data.x)
    out.angle.push_back(std::atan2(out.e2.dot(x - out.centre), out.e1.dot(x - out.centre)));
  return out;
}

double cost(const Data& data, const Circle& circle) {
  double sum = 0;
  for (std::size_t i = 0; i < data.x.size(); ++i)
    sum +=
        (data.whitener[i] * (data.x[i] - circle.centre - circle.radius * circle.direction(i))).squaredNorm();
  return sum;
}

// The linearised problem with each angle eliminated.
struct Linear {
  Matrix6 normal = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  std::vector<Eigen::Matrix<double, 3, 6>> by_circle;  // whitened
  std::vector<Eigen::Vector3d> by_angle, residual;
  std::vector<Eigen::Matrix<double, 6, 3>> by_point;  // d right / d x_i
};

Linear linearise(const Data& data, const Circle& circle) {
  Linear out;
  const Eigen::Vector3d n = circle.normal();
  for (std::size_t i = 0; i < data.x.size(); ++i) {
    const Eigen::Matrix3d& w = data.whitener[i];
    Eigen::Matrix<double, 3, 6> a;
    a << Eigen::Matrix3d::Identity(), -circle.radius * std::cos(circle.angle[i]) * n,
        -circle.radius * std::sin(circle.angle[i]) * n, circle.direction(i);
    const Eigen::Matrix<double, 3, 6> wa = w * a;
    const Eigen::Vector3d b = w * circle.radius * circle.tangent(i);
    const Eigen::Vector3d r = w * (data.x[i] - circle.centre - circle.radius * circle.direction(i));
    const Eigen::Matrix3d project = Eigen::Matrix3d::Identity() - b * b.transpose() / b.squaredNorm();
    out.normal += wa.transpose() * project * wa;
    out.right += wa.transpose() * project * r;
    out.by_circle.push_back(wa);
    out.by_angle.push_back(b);
    out.residual.push_back(r);
    out.by_point.push_back(wa.transpose() * project * w);
  }
  return out;
}

Circle moved(const Circle& from, const Linear& linear, const Vector6& step) {
  Circle out = from;
  const Eigen::Vector3d n = from.normal();
  out.centre += step.head<3>();
  out.e1 = (from.e1 - step[3] * n).normalized();
  const Eigen::Vector3d e2 = from.e2 - step[4] * n;
  out.e2 = (e2 - e2.dot(out.e1) * out.e1).normalized();
  out.radius += step[5];
  for (std::size_t i = 0; i < out.angle.size(); ++i) {
    const Eigen::Vector3d& b = linear.by_angle[i];
    out.angle[i] += b.dot(linear.residual[i] - linear.by_circle[i] * step) / b.squaredNorm();
  }
  return out;
}

Circle optimise(const Data& data, Circle at) {
  double now = cost(data, at), damping = 1e-3;
  constexpr int most_steps = 200;
  for (int step = 0; step < most_steps; ++step) {
    const Linear linear = linearise(data, at);
    Matrix6 normal = linear.normal;
    normal.diagonal() *= 1 + damping;
    const Vector6 delta = normal.ldlt().solve(linear.right);
    const double gain = linear.right.dot(linear.normal.ldlt().solve(linear.right));
    if (!delta.allFinite()) break;
    constexpr double done = 1e-14;  // of chi-square still to be gained
    if (gain < done * (1 + now)) return at;
    const Circle next = moved(at, linear, delta);
    const double there = cost(data, next);
    if (there < now) {
      at = next;
      now = there;
      damping = std::max(damping / 10, 1e-12);
    } else {
      constexpr double most_damping = 1e12, rounding = 1e-8;
      if (damping > most_damping) {
        if (gain < rounding * (1 + now)) return at;
        break;
      }
      damping *= 10;
    }
  }
  fail(ErrorKind::numeric, {}, "no circle found through the {} points of the pot outline: did not converge",
       data.x.size());
}

// Chi-square of the straight line through the points: a circle says something only where this is much larger.
double line_cost(const Data& data, const Circle& circle) {
  Eigen::Vector3d a = circle.centre + circle.radius * circle.direction(data.x.size() / 2);
  Eigen::Vector3d d = (data.x.back() - data.x.front()).normalized();
  double sum = 0;
  constexpr int steps = 10;  // the problem is linear but for the positions along the line
  for (int step = 0; step < steps; ++step) {
    const Eigen::Vector3d n1 = d.unitOrthogonal(), n2 = d.cross(n1);
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    sum = 0;
    for (std::size_t i = 0; i < data.x.size(); ++i) {
      const Eigen::Vector3d b = data.whitener[i] * d, whole = data.whitener[i] * (data.x[i] - a);
      const double t = b.dot(whole) / b.squaredNorm();
      const Eigen::Vector3d r = whole - t * b;
      Eigen::Matrix<double, 3, 4> by_line;
      by_line << n1, n2, t * n1, t * n2;
      by_line = (data.whitener[i] * by_line).eval();
      by_line -= (b * (b.transpose() * by_line) / b.squaredNorm()).eval();
      normal += by_line.transpose() * by_line;
      right += by_line.transpose() * r;
      sum += r.squaredNorm();
    }
    const Eigen::Vector4d delta = normal.ldlt().solve(right);
    a += delta[0] * n1 + delta[1] * n2;
    d = (d + delta[2] * n1 + delta[3] * n2).normalized();
  }
  return sum;
}

Data data_of(const std::vector<const ReconstructedPoint*>& points, double roughness) {
  Data out;
  for (const ReconstructedPoint* p : points) {
    out.x.push_back(p->estimate->x_m);
    const Eigen::Matrix3d c =
        p->estimate->digitising_covariance_m2 + roughness * roughness * Eigen::Matrix3d::Identity();
    out.whitener.push_back(c.llt().matrixL().solve(Eigen::Matrix3d::Identity().eval()));
  }
  return out;
}

struct Fit {
  double roughness;
  Data data;
  Circle circle;
};

Fit fit(const std::vector<const ReconstructedPoint*>& points, int dof) {
  Fit out{0, data_of(points, 0), {}};
  out.circle = optimise(out.data, start(out.data));
  double low = 0, high = out.circle.radius;
  if (cost(out.data, out.circle) <= dof) return out;
  constexpr double precise = 1e-4;
  while (high - low > precise * high) {
    out.roughness = 0.5 * (low + high);
    out.data = data_of(points, out.roughness);
    out.circle = optimise(out.data, start(out.data));
    (cost(out.data, out.circle) > dof ? low : high) = out.roughness;
  }
  return out;
}

}  // namespace

std::vector<const ReconstructedPoint*> pot_outline(const Vectors& vectors) {
  std::vector<const ReconstructedPoint*> out;
  for (const ReconstructedPoint& p : vectors.points) {
    if (p.accepted() && p.label.organ == "pot" && p.label.feature == "outline") out.push_back(&p);
  }
  return out;
}

Rim fit_rim(const std::vector<const ReconstructedPoint*>& points, const Eigen::MatrixXd& rig_covariance,
            const Eigen::Vector3d& towards) {
  constexpr std::size_t least_points = 4;
  if (points.size() < least_points)
    bad_input({}, "{} accepted points labelled organ 'pot', feature 'outline'; a rim needs at least {}",
              points.size(), least_points);
  Rim out;
  out.points = static_cast<int>(points.size());
  out.dof = 2 * out.points - 6;
  const auto [roughness, data, circle] = fit(points, out.dof);
  const Linear linear = linearise(data, circle);
  const Eigen::LDLT<Matrix6> solver(linear.normal);

  Matrix6 covariance = solver.solve(Matrix6::Identity());
  if (rig_covariance.size() > 0) {
    Eigen::MatrixXd by_rig = Eigen::MatrixXd::Zero(6, rig_covariance.rows());
    for (std::size_t i = 0; i < points.size(); ++i)
      by_rig += linear.by_point[i] * points[i]->estimate->by_rig;
    by_rig = solver.solve(by_rig).eval();
    covariance += by_rig * rig_covariance * by_rig.transpose();
  }
  out.roughness_m = roughness;
  out.chi2 = cost(data, circle);
  out.centre_m = circle.centre;
  out.normal = circle.normal().normalized();
  if (out.normal.dot(towards) < 0) out.normal = -out.normal;
  out.tilt_rad = std::atan2(out.normal.cross(towards).norm(), out.normal.dot(towards));
  out.diameter_m = 2 * circle.radius;
  out.diameter_sigma_m = 2 * std::sqrt(covariance(5, 5));
  out.normal_sigma_rad = std::sqrt(covariance(3, 3) + covariance(4, 4));
  double sum = 0;
  for (const auto& x : data.x) sum += std::pow(out.normal.dot(x - circle.centre), 2);
  out.plane_rms_m = std::sqrt(sum / out.points);
  constexpr double largest_share = 0.5, least_gain = 25;  // five standard errors
  if (!(line_cost(data, circle) > out.chi2 + least_gain))
    fail(ErrorKind::numeric, {}, "the pot outline does not tell a circle: a straight line fits as well");
  if (!(out.diameter_sigma_m < largest_share * out.diameter_m) || !(out.normal_sigma_rad < largest_share))
    fail(
        ErrorKind::numeric, {},
        "the pot outline does not tell a circle: diameter {:.3g} m with sigma {:.3g} m, normal to {:.3g} rad",
        out.diameter_m, out.diameter_sigma_m, out.normal_sigma_rad);
  return out;
}

}  // namespace bpms
