#include "calibrate/brown_conrady.h"

#include <ceres/jet.h>

#include <array>
#include <cstddef>

namespace bpms::brown_conrady {
namespace {

constexpr std::size_t degree = 6;
using Polynomial = std::array<double, degree + 1>;  // coefficients of s^0 ... s^6

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial out{};
  for (std::size_t i = 0; i <= degree; ++i) {
    for (std::size_t j = 0; i + j <= degree; ++j) out[i + j] += a[i] * b[j];
  }
  return out;
}

// s d/ds of a polynomial.
Polynomial scaled_derivative(Polynomial a) {
  for (std::size_t i = 0; i <= degree; ++i) a[i] *= static_cast<double>(i);
  return a;
}

// Bernstein coefficients on [0, 1]: the polynomial lies in their convex hull, and the two at the ends are its
// values. Halving until all are positive (yes) or an end is not (no) decides; a double root never does, and
// counts as no.
bool positive(const Polynomial& bernstein, int depth) {
  if (!(bernstein.front() > 0 && bernstein.back() > 0)) return false;
  bool all = true;
  for (const double b : bernstein) all = all && b > 0;
  if (all) return true;
  if (depth == 0) return false;
  Polynomial left = bernstein, right = bernstein;
  for (std::size_t step = 1; step <= degree; ++step) {  // de Casteljau at 1/2
    for (std::size_t i = 0; i + step <= degree; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
    left[step] = right[0];
  }
  return positive(left, depth - 1) && positive(right, depth - 1);
}

bool positive_up_to(Polynomial a, double s) {
  double power = 1;
  for (double& c : a) c *= power, power *= s;
  constexpr double binomial[degree + 1][degree + 1] = {
      {1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}, {1, 5, 10, 10, 5, 1}, {1, 6, 15, 20, 15, 6, 1}};
  Polynomial bernstein{};
  for (std::size_t i = 0; i <= degree; ++i) {
    for (std::size_t j = 0; j <= i; ++j) bernstein[i] += binomial[i][j] / binomial[degree][j] * a[j];
  }
  constexpr int halvings = 30;
  return positive(bernstein, halvings);
}

}  // namespace

bool monotone_up_to(const double* parameters, int count, double s) {
  if (count < 8) return true;
  const double* k = parameters + 4;
  const Polynomial n{1, k[0], k[1], count >= 9 ? k[4] : 0};
  if (count < 12) {  // d(r n)/dr = n + 2 s n'
    Polynomial slope = scaled_derivative(n);
    for (std::size_t i = 0; i <= degree; ++i) slope[i] = n[i] + 2 * slope[i];
    return positive_up_to(slope, s);
  }
  const Polynomial d{1, k[5], k[6], k[7]};
  if (!positive_up_to(d, s)) return false;
  // d(r n/d)/dr = (n d + 2 s (n' d - n d')) / d^2
  const Polynomial nd = product(n, d), dn = product(scaled_derivative(n), d),
                   nd1 = product(n, scaled_derivative(d));
  Polynomial slope{};
  for (std::size_t i = 0; i <= degree; ++i) slope[i] = nd[i] + 2 * (dn[i] - nd1[i]);
  return positive_up_to(slope, s);
}

std::optional<Derivatives> project_with_derivatives(const double* parameters, int count,
                                                    const Eigen::Vector3d& x_cam) {
  if (!(x_cam.z() > 0)) return std::nullopt;
  if (!monotone_up_to(parameters, count, x_cam.head<2>().squaredNorm() / (x_cam.z() * x_cam.z())))
    return std::nullopt;
  constexpr int most = 12;
  using Dual = ceres::Jet<double, most + 3>;
  std::array<Dual, most> p;
  for (int i = 0; i < count; ++i) p[static_cast<std::size_t>(i)] = Dual(parameters[i], i);
  const std::array<Dual, 3> x{Dual(x_cam.x(), most), Dual(x_cam.y(), most + 1), Dual(x_cam.z(), most + 2)};
  std::array<Dual, 2> pixel;
  project(p.data(), count, x.data(), pixel.data());
  Derivatives out;
  out.by_parameters.resize(2, count);
  for (int row = 0; row < 2; ++row) {
    const Dual& q = pixel[static_cast<std::size_t>(row)];
    out.pixel[row] = q.a;
    out.by_parameters.row(row) = q.v.head(count).transpose();
    out.by_x_cam.row(row) = q.v.tail<3>().transpose();
  }
  if (!out.pixel.allFinite()) return std::nullopt;
  return out;
}

}  // namespace bpms::brown_conrady
