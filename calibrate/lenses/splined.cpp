#include "calibrate/lenses/splined.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

constexpr std::size_t most_basis = 4;

struct KnotGrid {
  int order, columns, rows;
  double spacing;  // of the knots in u

  static KnotGrid of(const LensNumbers& lens) {
    const auto c = lens.constants;
    const int order = static_cast<int>(c[0]), columns = static_cast<int>(c[1]);
    return {order, columns, static_cast<int>(c[2]), 4 * std::tan(radians(c[3]) / 4) / (columns - order)};
  }
  Eigen::Vector2d knot(int column, int row) const {
    return spacing * Eigen::Vector2d(column - 0.5 * (columns - 1), row - 0.5 * (rows - 1));
  }
};

// The active knots along one axis, their weights and the weights' derivative by the position in knots.
struct SplineBasis {
  int first = 0;
  std::array<double, most_basis> weight{}, slope{};
};

std::optional<SplineBasis> spline_basis(int order, int knots, double position) {
  const double margin = 0.5 * (order - 1), last = knots - 1 - margin;
  if (!(position >= margin && position <= last)) return std::nullopt;
  SplineBasis out;
  if (order == 3) {
    const int cell = std::min(static_cast<int>(position), knots - 3);
    const double t = position - cell, s = 1 - t;
    out.first = cell - 1;
    out.weight = {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
                  t * t * t / 6};
    out.slope = {-s * s / 2, (3 * t * t - 4 * t) / 2, (4 * s - 3 * s * s) / 2, t * t / 2};
  } else {
    const int nearest = std::clamp(static_cast<int>(std::lround(position)), 1, knots - 2);
    const double t = position - nearest;
    out.first = nearest - 1;
    out.weight = {(0.5 - t) * (0.5 - t) / 2, 0.75 - t * t, (0.5 + t) * (0.5 + t) / 2, 0};
    out.slope = {t - 0.5, -2 * t, t + 0.5, 0};
  }
  return out;
}

struct SplinedPoint {
  SplineBasis x, y;
  Eigen::Vector2d value;     // u + delta
  Eigen::Matrix2d jacobian;  // by u
};

std::optional<SplinedPoint> splined_point(const LensNumbers& lens, const KnotGrid& grid,
                                          const Eigen::Vector2d& u) {
  const auto x = spline_basis(grid.order, grid.columns, u.x() / grid.spacing + 0.5 * (grid.columns - 1));
  const auto y = spline_basis(grid.order, grid.rows, u.y() / grid.spacing + 0.5 * (grid.rows - 1));
  if (!x || !y) return std::nullopt;
  SplinedPoint out{*x, *y, u, Eigen::Matrix2d::Identity()};
  for (int j = 0; j <= grid.order; ++j) {
    for (int i = 0; i <= grid.order; ++i) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const auto at = 4 + 2 * static_cast<std::size_t>((y->first + j) * grid.columns + x->first + i);
      const Eigen::Vector2d knot(lens.parameters[at], lens.parameters[at + 1]);
      out.value += x->weight[a] * y->weight[b] * knot;
      out.jacobian.col(0) += x->slope[a] * y->weight[b] / grid.spacing * knot;
      out.jacobian.col(1) += x->weight[a] * y->slope[b] / grid.spacing * knot;
    }
  }
  if (!(out.jacobian.determinant() > 0)) return std::nullopt;
  return out;
}

std::optional<Eigen::Vector2d> stereographic(const Eigen::Vector3d& x) {
  const double d = x.norm() + x.z();
  if (!(d > 0) || !x.allFinite()) return std::nullopt;
  return 2 / d * x.head<2>();
}

// Third differences along rows and columns and across them, of both components.
void add_smoothness(const KnotGrid& grid, std::vector<LensPrior>& out) {
  constexpr double third_derivative = 5;  // of a correction; -0.28 u^3, a webcam's, has 1.7
  const double sigma = third_derivative * std::pow(grid.spacing, 3);
  const std::array<std::vector<double>, 4> difference{
      std::vector<double>{1}, {-1, 1}, {1, -2, 1}, {-1, 3, -3, 1}};
  for (std::size_t along_x = 0; along_x < difference.size(); ++along_x) {
    const auto &a = difference[along_x], &b = difference[3 - along_x];
    const int wide = static_cast<int>(a.size()), high = static_cast<int>(b.size());
    for (int row = 0; row + high <= grid.rows; ++row) {
      for (int column = 0; column + wide <= grid.columns; ++column) {
        for (int component = 0; component < 2; ++component) {
          LensPrior prior{{}, 0, sigma};
          for (int j = 0; j < high; ++j) {
            for (int i = 0; i < wide; ++i)
              prior.coefficients.emplace_back(
                  4 + 2 * ((row + j) * grid.columns + column + i) + component,
                  a[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(j)]);
          }
          out.push_back(std::move(prior));
        }
      }
    }
  }
}

// A turn of the camera and a shift or turn of the corrections are the same: the corrections about the axis
// have no mean and no turn.
void add_gauge(const KnotGrid& grid, std::vector<LensPrior>& out) {
  constexpr double sigma = 1e-4;  // any: it chooses the frame, and no ray depends on it
  LensPrior x{{}, 0, sigma}, y{{}, 0, sigma}, turn{{}, 0, sigma};
  const double width = 0.25 * grid.spacing * std::min(grid.columns, grid.rows);
  double total = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      total += std::exp(-0.5 * grid.knot(column, row).squaredNorm() / (width * width));
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d u = grid.knot(column, row);
      const double weight = std::exp(-0.5 * u.squaredNorm() / (width * width)) / total;
      const int at = 4 + 2 * (row * grid.columns + column);
      x.coefficients.emplace_back(at, weight);
      y.coefficients.emplace_back(at + 1, weight);
      turn.coefficients.emplace_back(at, -weight * u.y() / width);
      turn.coefficients.emplace_back(at + 1, weight * u.x() / width);
    }
  }
  for (LensPrior* prior : {&x, &y, &turn}) out.push_back(std::move(*prior));
}

class Splined final : public Lens {
 public:
  std::string_view model() const override { return "splined_stereographic"; }

  std::vector<std::string> parameter_names(const LensNumbers& lens) const override {
    const auto c = lens.constants;
    constexpr double fewest = 5, most = 200;
    if (c.size() != 4 || !(c[0] == 2 || c[0] == 3) || !(c[3] > 0 && c[3] < 360)) return {};
    for (const double n : {c[1], c[2]})
      if (!(n >= fewest && n <= most && n == std::floor(n))) return {};
    const int columns = static_cast<int>(c[1]), rows = static_cast<int>(c[2]);
    if (lens.parameters.size() != static_cast<std::size_t>(splined_parameters(columns, rows))) return {};
    std::vector<std::string> out{"fx", "fy", "cx", "cy"};
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column)
        for (const char* axis : {"x", "y"}) out.push_back(fmt::format("d{}_{}_{}", axis, row, column));
    }
    return out;
  }

  std::string expected_numbers() const override {
    return "4 + 2 columns rows: fx fy cx cy and the corrections of the knots, with constants = [order 2 or "
           "3, "
           "columns, rows (5 to 200), fov_x_deg]";
  }

  bool covers_image() const override { return false; }
  std::vector<int> held(const LensNumbers&) const override { return {0, 1, 2, 3}; }
  std::vector<LensPrior> priors(const LensNumbers& lens) const override {
    const KnotGrid grid = KnotGrid::of(lens);
    std::vector<LensPrior> out;
    add_smoothness(grid, out);
    add_gauge(grid, out);
    return out;
  }
  std::string prior_words() const override {
    return "splined: third derivatives of the corrections are 0 +- 5 a unit of u cubed; their mean and turn "
           "about "
           "the axis are 0";
  }

  std::optional<Eigen::Vector2d> project(const LensNumbers& lens, const Eigen::Vector3d& x) const override {
    const auto u = stereographic(x);
    const auto at = u ? splined_point(lens, KnotGrid::of(lens), *u) : std::nullopt;
    if (!at) return std::nullopt;
    const auto p = lens.parameters;
    return Eigen::Vector2d(p[0] * at->value.x() + p[2], p[1] * at->value.y() + p[3]);
  }

  std::optional<LensDerivatives> project_with_derivatives(const LensNumbers& lens,
                                                          const Eigen::Vector3d& x) const override {
    const KnotGrid grid = KnotGrid::of(lens);
    const auto u = stereographic(x);
    const auto at = u ? splined_point(lens, grid, *u) : std::nullopt;
    if (!at) return std::nullopt;
    const auto p = lens.parameters;
    const Eigen::Vector2d f(p[0], p[1]);
    LensDerivatives out;
    out.pixel = f.cwiseProduct(at->value) + Eigen::Vector2d(p[2], p[3]);
    const double norm = x.norm(), d = norm + x.z();
    Eigen::Matrix<double, 2, 3> by_x;  // of u
    by_x << Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero();
    by_x = 2 / d * by_x - *u / d * Eigen::RowVector3d(x.x() / norm, x.y() / norm, x.z() / norm + 1);
    out.by_x_cam = f.asDiagonal() * at->jacobian * by_x;
    out.by_parameters.setZero(2, static_cast<Eigen::Index>(p.size()));
    out.by_parameters(0, 0) = at->value.x();
    out.by_parameters(1, 1) = at->value.y();
    out.by_parameters(0, 2) = out.by_parameters(1, 3) = 1;
    for (int j = 0; j <= grid.order; ++j) {
      for (int i = 0; i <= grid.order; ++i) {
        const Eigen::Index k = 4 + 2 * ((at->y.first + j) * grid.columns + at->x.first + i);
        const double weight =
            at->x.weight[static_cast<std::size_t>(i)] * at->y.weight[static_cast<std::size_t>(j)];
        out.by_parameters(0, k) = weight * f.x();
        out.by_parameters(1, k + 1) = weight * f.y();
      }
    }
    return out;
  }

  // Newton in u, steps halved until they help.
  std::optional<Eigen::Vector3d> unproject(const LensNumbers& lens,
                                           const Eigen::Vector2d& pixel) const override {
    const auto p = lens.parameters;
    const KnotGrid grid = KnotGrid::of(lens);
    const Eigen::Vector2d target((pixel.x() - p[2]) / p[0], (pixel.y() - p[3]) / p[1]);
    if (!target.allFinite()) return std::nullopt;
    const Eigen::Vector2d edge =
        0.5 * grid.spacing * Eigen::Vector2d(grid.columns - grid.order, grid.rows - grid.order);
    Eigen::Vector2d u = target.cwiseMin(0.99 * edge).cwiseMax(-0.99 * edge);
    auto at = splined_point(lens, grid, u);
    if (!at) at = splined_point(lens, grid, u = Eigen::Vector2d::Zero());
    if (!at) return std::nullopt;
    double error = (at->value - target).norm();
    const double enough = 1e-15 * (1 + target.norm());
    constexpr int most_steps = 50, most_halvings = 30;
    for (int i = 0; i < most_steps && error > enough; ++i) {
      const Eigen::Vector2d step = at->jacobian.inverse() * (target - at->value);
      bool better = false;
      for (double scale = 1; !better && scale > std::ldexp(1.0, -most_halvings); scale /= 2) {
        const auto there = splined_point(lens, grid, u + scale * step);
        if (!there || !((there->value - target).norm() < error)) continue;
        u += scale * step, at = there, error = (at->value - target).norm(), better = true;
      }
      if (!better) break;  // rounding, or the edge of the grid: the residual tells which
    }
    constexpr double tolerance = 1e-11;
    if (!(error < tolerance * (1 + target.norm()))) return std::nullopt;
    const double s = u.squaredNorm() / 4;
    return Eigen::Vector3d(u.x(), u.y(), 1 - s) / (1 + s);
  }
};

}  // namespace

const Lens& splined_lens() {
  static const Splined lens;
  return lens;
}

std::vector<double> splined_constants(const Camera& camera, std::vector<double> constants) {
  Eigen::Vector2d edge = Eigen::Vector2d::Zero();
  constexpr int steps = 32;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const auto ray =
          unproject(camera, {(camera.width_px - 1.0) * i / steps, (camera.height_px - 1.0) * j / steps});
      const auto u = ray ? stereographic(*ray) : std::nullopt;
      if (u) edge = edge.cwiseMax(u->cwiseAbs());
    }
  }
  const double order = constants[0], columns = constants[1], rows = constants[2];
  constexpr double margin = 1.05;  // the grid must reach beyond what a better lens will say
  const double half = margin * std::max(edge.x(), edge.y() * (columns - order) / (rows - order));
  constants[3] = degrees(4 * std::atan(half / 2));
  return constants;
}

}  // namespace bpms
