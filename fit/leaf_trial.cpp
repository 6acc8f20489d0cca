#include "fit/leaf_trial.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace bpms {
namespace {

double residual_rms(const CurveSolution& solution, const std::vector<LeafObservation>& observations) {
  double sum = 0;
  for (std::size_t k = 0; k < observations.size(); ++k)
    sum += solution.distance2[k] / std::max(1e-300, observations[k].whitening.squaredNorm());
  return std::sqrt(sum / static_cast<double>(observations.size()));
}

// A leaf and itself turned by half a turn with both angles' signs changed are one; leaves lean outward.
void lean_outward(const LeafProblem& problem, LeafTrial& trial) {
  Eigen::VectorXd& p = trial.solution.parameters;
  if (!problem.direction_free || p[trial.model.at_inclination()] >= 0) return;
  const Eigen::Index from = trial.model.at_inclination(), count = trial.model.at_twist() - from;
  p[trial.model.at_direction()] += pi;
  p.segment(from, count) *= -1;
  trial.solution.covariance.middleRows(from, count) *= -1;
  trial.solution.covariance.middleCols(from, count) *= -1;
}

}  // namespace

int numbers_that_count(const std::vector<LeafObservation>& observations) {
  int out = 0;
  for (const LeafObservation& o : observations)
    out += o.weight > 0 ? o.dimensions - (o.place_free ? 1 : 0) : 0;
  return out;
}

LeafTrial solve_midrib(const LeafProblem& problem, FunctionChoice inclination, FunctionChoice azimuth) {
  LeafTrial best{LeafModel(leaf_shape(problem, inclination, azimuth, {}, {})), {}};
  LeafModel model = best.model;
  constexpr double poor = 0.03;  // of the length: another start may find a better valley
  for (const int pieces : {8, 3, 20, 1}) {
    const CurveSolution found = solve_curves(model, problem.midrib, midrib_start(problem, model, pieces));
    const bool better = best.solution.parameters.size() == 0 ||
                        (found.converged && !best.solution.converged) ||
                        (found.converged == best.solution.converged && found.chi2 < best.solution.chi2);
    if (better) best.solution = found;
    if (best.solution.converged && residual_rms(best.solution, problem.midrib) < poor) break;
  }
  lean_outward(problem, best);
  best.model.set(best.solution.parameters, false);
  return best;
}

LeafTrial solve_edges(const LeafProblem& problem, const LeafTrial& midrib, const EdgeStart& edges,
                      FunctionChoice twist, FunctionChoice width) {
  LeafModelShape shape = midrib.model.shape();
  shape.twist = FunctionBasis(twist, true);
  shape.width = FunctionBasis(width, true);
  LeafTrial out{LeafModel(std::move(shape)), {}};
  Eigen::VectorXd start(out.model.parameters());
  const std::vector<double> ones(edges.l.size(), 1.0);
  start << midrib.solution.parameters, out.model.shape().twist.project(edges.l, edges.twist, ones),
      out.model.shape().width.project(edges.l, edges.width, ones);
  out.solution = solve_curves(out.model, problem.edges, start, midrib.model.parameters());
  out.model.set(out.solution.parameters, false);
  return out;
}

double variance_factor(double chi2, double degrees_of_freedom, bool errors_known) {
  if (degrees_of_freedom <= 0) return errors_known ? 1.0 : std::numeric_limits<double>::quiet_NaN();
  const double per_dof = chi2 / degrees_of_freedom;
  return errors_known ? std::max(1.0, per_dof) : per_dof;
}

Eigen::MatrixXd midrib_covariance(const LeafProblem& problem, LeafTrial& midrib) {
  const CurveSolution& s = midrib.solution;
  midrib.variance_factor = variance_factor(s.chi2, s.degrees_of_freedom(), problem.errors_known);
  return midrib.variance_factor * s.covariance;
}

Eigen::MatrixXd surface_covariance(const LeafProblem& problem, const Eigen::MatrixXd& midrib_covariance,
                                   LeafTrial& edges) {
  const CurveSolution& s = edges.solution;
  const Eigen::Index m = midrib_covariance.rows(), e = s.covariance.rows();
  const Eigen::MatrixXd by_midrib = s.jacobian.leftCols(m), by_edges = s.jacobian.rightCols(e);
  // d(twist, width)/d(midrib) at the minimum; what of the midrib's error is left in the residuals raises
  // chi2.
  const Eigen::MatrixXd gain = -s.covariance * by_edges.transpose() * by_midrib;
  const Eigen::MatrixXd left = by_midrib + by_edges * gain;
  const double inherited = (left * midrib_covariance).cwiseProduct(left).sum();
  edges.variance_factor = variance_factor(s.chi2, s.degrees_of_freedom() + inherited, problem.errors_known);
  Eigen::MatrixXd out(m + e, m + e);
  out.topLeftCorner(m, m) = midrib_covariance;
  out.bottomLeftCorner(e, m) = gain * midrib_covariance;
  out.topRightCorner(m, e) = out.bottomLeftCorner(e, m).transpose();
  out.bottomRightCorner(e, e) =
      edges.variance_factor * s.covariance + gain * midrib_covariance * gain.transpose();
  return out;
}

}  // namespace bpms
