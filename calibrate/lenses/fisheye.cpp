#include "calibrate/lenses/fisheye.h"

#include <cmath>

#include "calibrate/lenses/positive_polynomial.h"
#include "core/units.h"

namespace bpms {
namespace {

constexpr std::size_t fisheye_count = 8;

double distorted_angle(const double* k, double theta) {
  const double s = theta * theta;
  return theta * (1 + s * (k[0] + s * (k[1] + s * (k[2] + s * k[3]))));
}
double angle_slope(const double* k, double theta) {
  const double s = theta * theta;
  return 1 + s * (3 * k[0] + s * (5 * k[1] + s * (7 * k[2] + s * 9 * k[3])));
}
bool rises_up_to(const double* k, double theta) {
  return positive_up_to({1, 3 * k[0], 5 * k[1], 7 * k[2], 9 * k[3]}, theta * theta);
}

// The angle of a distorted one: Newton's steps within a bracket, halved where they leave it.
std::optional<double> undistorted_angle(const double* k, double theta_d) {
  double low = 0, high = pi, theta = std::min(theta_d, pi);
  constexpr int most_steps = 200;
  const double enough = 1e-15 * (1 + theta_d);
  for (int i = 0; i < most_steps; ++i) {
    const double error = distorted_angle(k, theta) - theta_d;
    if (!rises_up_to(k, theta)) {
      high = theta;
    } else {
      if (std::abs(error) <= enough) return theta;
      (error > 0 ? high : low) = theta;
    }
    const double newton = theta - error / angle_slope(k, theta), before = theta;
    theta = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (theta == before) break;  // rounding, or the edge of the region: the residual tells which
  }
  constexpr double tolerance = 1e-12;
  if (!rises_up_to(k, theta) || !(std::abs(distorted_angle(k, theta) - theta_d) < tolerance * (1 + theta_d)))
    return std::nullopt;
  return theta;
}

// A point by its distance from the axis; nullopt where the model ends.
struct AngleOfPoint {
  double r, theta, theta_d, slope;
  Eigen::Vector2d towards;  // (X, Y) / r
};
std::optional<AngleOfPoint> angle_of_point(const LensNumbers& lens, const Eigen::Vector3d& x) {
  const double r = x.head<2>().norm();
  if (!(r > 0 || x.z() > 0) || !x.allFinite()) return std::nullopt;
  const double* k = lens.parameters.data() + 4;
  const double theta = std::atan2(r, x.z());
  if (!rises_up_to(k, theta)) return std::nullopt;
  return AngleOfPoint{r, theta, distorted_angle(k, theta), angle_slope(k, theta),
                      r > 0 ? Eigen::Vector2d(x.head<2>() / r) : Eigen::Vector2d(1, 0)};
}

class Fisheye final : public Lens {
 public:
  std::string_view model() const override { return "fisheye"; }

  std::vector<std::string> parameter_names(const LensNumbers& lens) const override {
    if (lens.parameters.size() != fisheye_count || !lens.constants.empty()) return {};
    return {"fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4"};
  }

  std::string expected_numbers() const override { return "8: fx fy cx cy k1 k2 k3 k4"; }

  bool covers_image() const override { return false; }

  std::optional<Eigen::Vector2d> project(const LensNumbers& lens, const Eigen::Vector3d& x) const override {
    const auto at = angle_of_point(lens, x);
    if (!at) return std::nullopt;
    const auto p = lens.parameters;
    const Eigen::Vector2d pixel(p[0] * at->theta_d * at->towards.x() + p[2],
                                p[1] * at->theta_d * at->towards.y() + p[3]);
    if (!pixel.allFinite()) return std::nullopt;
    return pixel;
  }

  std::optional<LensDerivatives> project_with_derivatives(const LensNumbers& lens,
                                                          const Eigen::Vector3d& x) const override {
    const auto at = angle_of_point(lens, x);
    if (!at) return std::nullopt;
    const auto p = lens.parameters;
    const Eigen::Vector2d& n = at->towards;
    const Eigen::Vector2d f(p[0], p[1]), distorted = at->theta_d * n;
    LensDerivatives out;
    out.pixel = f.cwiseProduct(distorted) + Eigen::Vector2d(p[2], p[3]);
    if (!out.pixel.allFinite()) return std::nullopt;
    // Across the direction from the axis theta_d / r, along it d(theta_d)/dr; on the axis both are 1/Z.
    const double square = x.squaredNorm(), along = at->slope * x.z() / square;
    const double across = at->r > 0 ? at->theta_d / at->r : along;
    Eigen::Matrix<double, 2, 3> by_x;
    by_x << across * Eigen::Matrix2d::Identity() + (along - across) * n * n.transpose(),
        -at->slope * at->r / square * n;
    out.by_x_cam = f.asDiagonal() * by_x;
    out.by_parameters.setZero(2, static_cast<Eigen::Index>(fisheye_count));
    out.by_parameters(0, 0) = distorted.x();
    out.by_parameters(1, 1) = distorted.y();
    out.by_parameters(0, 2) = out.by_parameters(1, 3) = 1;
    double power = at->theta;
    for (Eigen::Index i = 4; i < 8; ++i) {
      power *= at->theta * at->theta;
      out.by_parameters.col(i) = power * f.cwiseProduct(n);
    }
    return out;
  }

  std::optional<Eigen::Vector3d> unproject(const LensNumbers& lens,
                                           const Eigen::Vector2d& pixel) const override {
    const auto p = lens.parameters;
    const Eigen::Vector2d distorted((pixel.x() - p[2]) / p[0], (pixel.y() - p[3]) / p[1]);
    if (!distorted.allFinite()) return std::nullopt;
    const double theta_d = distorted.norm();
    if (theta_d == 0) return Eigen::Vector3d::UnitZ();
    const auto theta = undistorted_angle(p.data() + 4, theta_d);
    if (!theta) return std::nullopt;
    const Eigen::Vector2d side = std::sin(*theta) / theta_d * distorted;
    return Eigen::Vector3d(side.x(), side.y(), std::cos(*theta));
  }
};

}  // namespace

const Lens& fisheye_lens() {
  static const Fisheye lens;
  return lens;
}

}  // namespace bpms
