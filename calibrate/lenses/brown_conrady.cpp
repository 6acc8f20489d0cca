#include "calibrate/lenses/brown_conrady.h"

#include <ceres/jet.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "calibrate/lenses/positive_polynomial.h"

namespace bpms::brown_conrady {

bool monotone_up_to(const double* parameters, int count, double s) {
  if (count < 8) return true;
  const double* k = parameters + 4;
  const Polynomial n{1, k[0], k[1], count >= 9 ? k[4] : 0};
  if (count < 12) {  // d(r n)/dr = n + 2 s n'
    Polynomial slope = scaled_derivative(n);
    for (std::size_t i = 0; i <= polynomial_degree; ++i) slope[i] = n[i] + 2 * slope[i];
    return positive_up_to(slope, s);
  }
  const Polynomial d{1, k[5], k[6], k[7]};
  if (!positive_up_to(d, s)) return false;
  // d(r n/d)/dr = (n d + 2 s (n' d - n d')) / d^2
  const Polynomial nd = product(n, d), dn = product(scaled_derivative(n), d),
                   nd1 = product(n, scaled_derivative(d));
  Polynomial slope{};
  for (std::size_t i = 0; i <= polynomial_degree; ++i) slope[i] = nd[i] + 2 * (dn[i] - nd1[i]);
  return positive_up_to(slope, s);
}

}  // namespace bpms::brown_conrady

namespace bpms {
namespace {

namespace brown = brown_conrady;
constexpr std::size_t most_brown = 12;

int brown_count(const LensNumbers& lens) {
  return static_cast<int>(lens.parameters.size());
}

bool inside_monotone_region(const LensNumbers& lens, const Eigen::Vector2d& x) {
  return brown::monotone_up_to(lens.parameters.data(), brown_count(lens), x.squaredNorm());
}

// Distorted normalised coordinates and their 2x2 derivative.
struct Distorted {
  Eigen::Vector2d value;
  Eigen::Matrix2d jacobian;
};
Distorted distorted(const LensNumbers& lens, const Eigen::Vector2d& x) {
  using Dual = ceres::Jet<double, 2>;
  std::array<Dual, most_brown> parameters;
  std::transform(lens.parameters.begin(), lens.parameters.end(), parameters.begin(),
                 [](double p) { return Dual(p); });
  Dual xd, yd;
  brown::distort(parameters.data(), brown_count(lens), Dual(x.x(), 0), Dual(x.y(), 1), xd, yd);
  Distorted out{{xd.a, yd.a}, {}};
  out.jacobian << xd.v.transpose(), yd.v.transpose();
  return out;
}

class BrownConrady final : public Lens {
 public:
  std::string_view model() const override { return "brown_conrady"; }

  std::vector<std::string> parameter_names(const LensNumbers& lens) const override {
    static const char* const names[] = {"fx", "fy", "cx", "cy", "k1", "k2",
                                        "p1", "p2", "k3", "k4", "k5", "k6"};
    if (!brown::known_count(brown_count(lens)) || !lens.constants.empty()) return {};
    return {names, names + lens.parameters.size()};
  }

  std::string expected_numbers() const override {
    return "4, 8, 9 or 12: fx fy cx cy [k1 k2 p1 p2 [k3 [k4 k5 k6]]]";
  }

  std::optional<Eigen::Vector2d> project(const LensNumbers& lens,
                                         const Eigen::Vector3d& x_cam) const override {
    if (!(x_cam.z() > 0) || !inside_monotone_region(lens, x_cam.hnormalized())) return std::nullopt;
    Eigen::Vector2d pixel;
    brown::project(lens.parameters.data(), brown_count(lens), x_cam.data(), pixel.data());
    if (!pixel.allFinite()) return std::nullopt;
    return pixel;
  }

  std::optional<LensDerivatives> project_with_derivatives(const LensNumbers& lens,
                                                          const Eigen::Vector3d& x_cam) const override {
    if (!(x_cam.z() > 0) || !inside_monotone_region(lens, x_cam.hnormalized())) return std::nullopt;
    using Dual = ceres::Jet<double, most_brown + 3>;
    constexpr int point = most_brown;
    std::array<Dual, most_brown> p;
    const int count = brown_count(lens);
    for (std::size_t i = 0; i < lens.parameters.size(); ++i)
      p[i] = Dual(lens.parameters[i], static_cast<int>(i));
    const std::array<Dual, 3> x{Dual(x_cam.x(), point), Dual(x_cam.y(), point + 1),
                                Dual(x_cam.z(), point + 2)};
    std::array<Dual, 2> pixel;
    brown::project(p.data(), count, x.data(), pixel.data());
    LensDerivatives out;
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

  // Newton with the analytic Jacobian, steps halved until they help.
  std::optional<Eigen::Vector3d> unproject(const LensNumbers& lens,
                                           const Eigen::Vector2d& pixel) const override {
    const auto p = lens.parameters;
    const Eigen::Vector2d target((pixel.x() - p[2]) / p[0], (pixel.y() - p[3]) / p[1]);
    if (!target.allFinite()) return std::nullopt;
    Eigen::Vector2d x = inside_monotone_region(lens, target) ? target : Eigen::Vector2d::Zero();
    Distorted at = distorted(lens, x);
    double error = (at.value - target).norm();
    const double enough = 1e-14 * (1 + target.norm());
    constexpr int most_steps = 50, most_halvings = 30;
    for (int i = 0; i < most_steps && error > enough; ++i) {
      if (!(at.jacobian.determinant() > 0)) return std::nullopt;
      const Eigen::Vector2d step = at.jacobian.inverse() * (target - at.value);
      bool better = false;
      for (double scale = 1; !better && scale > std::ldexp(1.0, -most_halvings); scale /= 2) {
        const Eigen::Vector2d trial = x + scale * step;
        if (!trial.allFinite() || !inside_monotone_region(lens, trial)) continue;
        const Distorted there = distorted(lens, trial);
        const double trial_error = (there.value - target).norm();
        if (!(trial_error < error)) continue;
        x = trial, at = there, error = trial_error, better = true;
      }
      if (!better) break;  // rounding, or the edge of the region: the residual tells which
    }
    constexpr double tolerance = 1e-11;
    if (!(error < tolerance * (1 + target.norm())) || !(at.jacobian.determinant() > 0)) return std::nullopt;
    return Eigen::Vector3d(x.x(), x.y(), 1).normalized();
  }
};

}  // namespace

const Lens& brown_conrady_lens() {
  static const BrownConrady lens;
  return lens;
}

}  // namespace bpms
