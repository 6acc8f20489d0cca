#include "fit/curve_solver.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace bpms {
namespace {

// The place on the curve nearest to the observation, by Gauss-Newton steps from `l`, kept to [0, 1].
double nearest_place(const LeafModel& model, const LeafObservation& o, double l, LeafModel::Point& point) {
  constexpr int most_steps = 30;
  constexpr double longest_step = 0.1, tolerance = 1e-12;
  model.point(o.curve, l, false, point);
  Eigen::Vector3d r = o.whitening * (o.x - point.x);
  for (int k = 0; k < most_steps; ++k) {
    const Eigen::Vector3d tangent = o.whitening * point.tangent;
    const double norm2 = tangent.squaredNorm();
    if (norm2 <= 0) break;
    double step = std::clamp(tangent.dot(r) / norm2, -longest_step, longest_step);
    bool better = false;
    for (int halvings = 0; halvings < 4 && !better; ++halvings, step /= 2) {
      const double next = std::clamp(l + step, 0.0, 1.0);
      if (std::abs(next - l) < tolerance) return l;
      LeafModel::Point there;
      model.point(o.curve, next, false, there);
      const Eigen::Vector3d r_there = o.whitening * (o.x - there.x);
      if (r_there.squaredNorm() <= r.squaredNorm()) {
        l = next;
        point = there;
        r = r_there;
        better = true;
      }
    }
    if (!better) break;
  }
  return l;
}

struct CurveResiduals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  LeafModel& model;
  const std::vector<LeafObservation>& observations;
  Eigen::VectorXd held;           // the model's first parameters
  mutable std::vector<double> l;  // places at the last accepted parameters

  int NumResiduals() const { return static_cast<int>(3 * observations.size()); }
  int NumParameters() const { return model.parameters() - static_cast<int>(held.size()); }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    Eigen::VectorXd all(model.parameters());
    all << held, Eigen::Map<const Eigen::VectorXd>(parameters, NumParameters());
    if (jacobian == nullptr) {
      evaluate(all, residuals, nullptr);
      return true;
    }
    Eigen::MatrixXd by_all(NumResiduals(), model.parameters());
    evaluate(all, residuals, &by_all);
    Eigen::Map<Eigen::MatrixXd>(jacobian, NumResiduals(), NumParameters()) =
        by_all.rightCols(NumParameters());
    return true;
  }

  void evaluate(const Eigen::VectorXd& all, double* residuals, Eigen::MatrixXd* jacobian) const {
    model.set(all, jacobian != nullptr);
    LeafModel::Point point;
    for (std::size_t k = 0; k < observations.size(); ++k) {
      const LeafObservation& o = observations[k];
      const double place = o.place_free ? nearest_place(model, o, l[k], point) : o.l;
      const double root = std::sqrt(o.weight);
      model.point(o.curve, place, jacobian != nullptr, point);
      const auto row = static_cast<Eigen::Index>(3 * k);
      Eigen::Map<Eigen::Vector3d>(residuals + row) = root * (o.whitening * (point.x - o.x));
      if (jacobian == nullptr) continue;
      l[k] = place;
      Eigen::Matrix3Xd j = root * (o.whitening * point.jacobian);
      if (o.place_free && place > 0 && place < 1) {
        const Eigen::Vector3d tangent = (o.whitening * point.tangent).normalized();
        j -= tangent * (tangent.transpose() * j);
      }
      jacobian->middleRows(row, 3) = j;
    }
  }
};

// Inverse of J'J by its eigenvectors after scaling the columns to unit length; false where it is singular.
bool invert_normal_matrix(const Eigen::MatrixXd& jacobian, Eigen::MatrixXd& inverse) {
  const Eigen::VectorXd norm = jacobian.colwise().norm();
  const double largest = norm.size() > 0 ? norm.maxCoeff() : 0;
  Eigen::VectorXd scale(norm.size());
  bool full = true;
  for (Eigen::Index k = 0; k < norm.size(); ++k) {
    full = full && norm[k] > 1e-10 * largest;
    scale[k] = norm[k] > 1e-10 * largest ? 1 / norm[k] : 0;
  }
  const Eigen::MatrixXd scaled = jacobian * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled.transpose() * scaled);
  constexpr double singular = 1e-12;
  Eigen::VectorXd d = eigen.eigenvalues();
  for (Eigen::Index k = 0; k < d.size(); ++k) {
    const bool seen = d[k] > singular;
    full = full && seen;
    d[k] = seen ? 1 / d[k] : 0;
  }
  inverse = scale.asDiagonal() * eigen.eigenvectors() * d.asDiagonal() * eigen.eigenvectors().transpose() *
            scale.asDiagonal();
  return full;
}

}  // namespace

CurveSolution solve_curves(LeafModel& model, const std::vector<LeafObservation>& observations,
                           const Eigen::VectorXd& start, int held) {
  CurveResiduals function{model, observations, start.head(held), {}};
  for (const LeafObservation& o : observations) function.l.push_back(o.l);
  ceres::TinySolver<CurveResiduals> solver;
  solver.options.max_num_iterations = 200;
  // Whitened residuals are of order one; the last digits are wanted because tests compare with exact leaves.
  solver.options.gradient_tolerance = 1e-11;
  solver.options.parameter_tolerance = 1e-11;
  solver.options.function_tolerance = 1e-14;
  solver.options.cost_threshold = 1e-26;
  Eigen::VectorXd parameters = start.tail(start.size() - held);
  solver.Solve(function, &parameters);

  CurveSolution out;
  const auto rows = static_cast<Eigen::Index>(3 * observations.size());
  Eigen::VectorXd residuals(rows);
  out.parameters = start;
  out.parameters.tail(parameters.size()) = parameters;
  out.jacobian.resize(rows, model.parameters());
  function.evaluate(out.parameters, residuals.data(), &out.jacobian);
  out.full_rank = invert_normal_matrix(out.jacobian.rightCols(parameters.size()), out.covariance);
  out.converged = solver.summary.status != ceres::TinySolver<CurveResiduals>::HIT_MAX_ITERATIONS &&
                  residuals.allFinite() && parameters.allFinite();
  out.l = function.l;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const LeafObservation& o = observations[k];
    LeafModel::Point point;
    model.point(o.curve, out.l[k], false, point);
    out.distance2.push_back((o.whitening * (o.x - point.x)).squaredNorm());
    if (o.weight <= 0) continue;
    out.chi2 += o.weight * out.distance2.back();
    out.residuals += o.dimensions - (o.place_free ? 1 : 0);
  }
  return out;
}

}  // namespace bpms
