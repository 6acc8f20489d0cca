#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/interrupt.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/units.h"
#include "fit/edge_fit.h"
#include "fit/fit.h"
#include "fit/function_search.h"
#include "fit/leaf_trial.h"
#include "fit/outliers.h"

namespace bpms {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

FittedFunction fitted_function(const FunctionBasis& basis, const Eigen::VectorXd& parameters,
                               const Eigen::MatrixXd& covariance, int at, double unit) {
  FittedFunction out;
  out.basis = basis;
  out.choice = basis.choice();
  const Eigen::MatrixXd& t = basis.transform();
  out.coefficients = unit * t * parameters.segment(at, basis.size());
  out.covariance = unit * unit * t * covariance.block(at, at, basis.size(), basis.size()) * t.transpose();
  return out;
}

double rms_at_equal_arc(const LeafProblem& problem, const LeafModel& model) {
  LeafModel::Point base, point;
  model.point(LeafCurve::midrib, 0, false, base);
  double sum = 0;
  for (const LeafObservation& o : problem.midrib) {
    model.point(LeafCurve::midrib, o.l, false, point);
    sum += ((point.x - base.x) - (o.x - problem.midrib.front().x)).squaredNorm();
  }
  return problem.scale_m * std::sqrt(sum / static_cast<double>(problem.midrib.size()));
}

// The midrib is solved; the edges where there are any.
void set_result(const LeafProblem& problem, LeafTrial& midrib, std::optional<LeafTrial>& edges,
                OrganFit& out) {
  const LeafModel& model = edges ? edges->model : midrib.model;
  const LeafModelShape& shape = model.shape();
  const Eigen::VectorXd& parameters = edges ? edges->solution.parameters : midrib.solution.parameters;
  const double scale = problem.scale_m;
  Eigen::MatrixXd covariance = midrib_covariance(problem, midrib);
  out.errors_known = problem.errors_known;
  out.chi2 = midrib.solution.chi2;
  out.degrees_of_freedom = midrib.solution.degrees_of_freedom();
  if (problem.errors_known && out.degrees_of_freedom > 0)
    out.chi2_per_dof = out.chi2 / out.degrees_of_freedom;
  out.variance_factor = midrib.variance_factor;
  if (edges) {
    covariance = surface_covariance(problem, covariance, *edges);
    if (problem.errors_known && edges->solution.degrees_of_freedom() > 0)
      out.edge_chi2_per_dof = edges->solution.chi2 / edges->solution.degrees_of_freedom();
  }
  if (!midrib.solution.full_rank || (edges && !edges->solution.full_rank)) {
    covariance.setConstant(nan);
    out.notes.push_back("the points do not determine all of the leaf's parameters: no standard errors");
  }
  if (!problem.errors_known)
    out.sigma_m = scale * std::sqrt(out.variance_factor) / problem.midrib.front().whitening.col(0).norm();
  out.length_m = scale * parameters[LeafModel::at_length()];
  out.length_sigma_m = scale * std::sqrt(covariance(0, 0));
  out.direction = shape.direction_free ? parameters[model.at_direction()] : shape.direction;
  out.direction -= 2 * pi * std::round(out.direction / (2 * pi));
  out.direction_sigma =
      shape.direction_free ? std::sqrt(covariance(model.at_direction(), model.at_direction())) : nan;
  out.base_m = scale * shape.base;
  for (std::size_t i = 0; i < shape.base_axes.size(); ++i) {
    const int at_i = model.at_base() + static_cast<int>(i);
    out.base_m[shape.base_axes[i]] += scale * parameters[at_i];
    for (std::size_t j = 0; j < shape.base_axes.size(); ++j)
      out.base_covariance_m2(shape.base_axes[i], shape.base_axes[j]) =
          scale * scale * covariance(at_i, model.at_base() + static_cast<int>(j));
  }
  const auto keep = [&](FunctionRole role, const FunctionBasis& basis, int at, double unit) {
    if (basis.size() == 0) return;
    FittedFunction function = fitted_function(basis, parameters, covariance, at, unit);
    const CurveSolution& own = at < model.at_twist() ? midrib.solution : edges->solution;
    function.aicc = corrected_akaike(own.chi2, own.residuals, static_cast<int>(own.covariance.rows()),
                                     problem.errors_known, 1);
    for (const auto& [choice, aicc] : out.aicc_table[role_name(role)])
      if (choice == function.choice) function.aicc = aicc;
    out.functions.emplace(role_name(role), std::move(function));
  };
  keep(FunctionRole::inclination, shape.inclination, model.at_inclination(), 1);
  keep(FunctionRole::azimuth, shape.azimuth, model.at_azimuth(), 1);
  keep(FunctionRole::twist, shape.twist, model.at_twist(), 1);
  keep(FunctionRole::width, shape.width, model.at_width(), scale);
  constexpr int steps = 40;
  for (int k = 0; k <= steps; ++k) {
    LeafModel::Point point;
    model.point(LeafCurve::midrib, static_cast<double>(k) / steps, false, point);
    out.fitted_m.push_back(scale * point.x);
  }
  out.rms_m = rms_at_equal_arc(problem, model);
  out.width_m = out.width_sigma_m = nan;
  if (const auto width = out.functions.find("width"); width != out.functions.end()) {
    constexpr int grid = 200;
    double widest = 0;
    for (int k = 0; k <= grid; ++k) {
      const double l = static_cast<double>(k) / grid;
      if (width->second.value(l) > width->second.value(widest)) widest = l;
    }
    out.width_m = width->second.value(widest);
    out.width_sigma_m = width->second.sigma(widest);
  }
}

void fit_known_good(const MeasuredOrgan& organ, const FitOptions& options, OrganFit& out) {
  std::optional<LeafProblem> problem = leaf_problem(organ, options, out.failure);
  if (!problem) return;
  const int midrib_numbers = numbers_that_count(problem->midrib);
  const auto count = [&](FunctionChoice i, FunctionChoice a) {
    return LeafModel(leaf_shape(*problem, i, a, {}, {})).parameters();
  };
  const bool has_azimuth = !problem->planar;
  FunctionChoice azimuth = options.functions.azimuth.value_or(FunctionChoice{'p', has_azimuth ? 2 : 0});
  FunctionChoice inclination = options.functions.inclination.value_or(FunctionChoice{'p', 3});
  if (!has_azimuth) azimuth = {'p', 0};
  // What the points cannot carry is not asked of them.
  const FunctionChoice asked_inclination = inclination, asked_azimuth = azimuth;
  while (count(inclination, azimuth) >= midrib_numbers) {
    if (azimuth.order >= inclination.order && lower_order(azimuth)) continue;
    if (!lower_order(inclination) && !lower_order(azimuth)) break;
  }
  const auto midrib_candidate = [&](FunctionChoice i, FunctionChoice a) -> std::optional<LeafTrial> {
    if (count(i, a) >= midrib_numbers) return std::nullopt;
    return solve_midrib(*problem, i, a);
  };
  if (!options.functions.inclination) {
    const auto best = choose_function(
        function_candidates(FunctionRole::inclination), problem->errors_known,
        [&](FunctionChoice c) { return midrib_candidate(c, azimuth); }, out.aicc_table["inclination"]);
    if (best) inclination = *best;
  } else if (!(inclination == asked_inclination)) {
    out.notes.push_back(fmt::format("too few points for inclination {}: {} fitted", asked_inclination.str(),
                                    inclination.str()));
  }
  if (has_azimuth && !options.functions.azimuth) {
    const auto best = choose_function(
        function_candidates(FunctionRole::azimuth), problem->errors_known,
        [&](FunctionChoice c) { return midrib_candidate(inclination, c); }, out.aicc_table["azimuth"]);
    if (best) azimuth = *best;
  } else if (!(azimuth == asked_azimuth)) {
    out.notes.push_back(
        fmt::format("too few points for azimuth {}: {} fitted", asked_azimuth.str(), azimuth.str()));
  }
  LeafTrial trial = solve_midrib(*problem, inclination, azimuth);
  if (!trial.usable()) {
    out.failure = "the fit of the midrib did not converge";
    return;
  }
  std::optional<LeafTrial> edges;
  if (!problem->edges.empty()) edges = fit_edges(*problem, trial, options.functions, out);
  set_result(*problem, trial, edges, out);
}

}  // namespace

double FittedFunction::value(double l) const {
  Eigen::VectorXd phi(coefficients.size());
  basis.raw(l, phi.data());
  return phi.dot(coefficients);
}

double FittedFunction::sigma(double l) const {
  Eigen::VectorXd phi(coefficients.size());
  basis.raw(l, phi.data());
  return std::sqrt(phi.dot(covariance * phi));
}

OrganFit fit_organ(const MeasuredOrgan& organ, const FitOptions& options) {
  OrganFit out;
  out.measured = organ;
  for (const VectorPoint& p : organ.midrib) out.points_m.push_back(p.x_m);
  MeasuredOrgan kept = organ;
  out.outliers = remove_outliers(kept, options);
  fit_known_good(kept, options, out);
  return out;
}

std::vector<OrganFit> fit_organs(const std::vector<MeasuredOrgan>& organs, const FitOptions& options) {
  std::vector<OrganFit> out(organs.size());
  Progress progress("fitting", organs.size());
  parallel_for(organs.size(), [&](std::size_t k) {
    throw_if_interrupted();
    out[k] = fit_organ(organs[k], options);
    progress.add();
  });
  return out;
}

}  // namespace bpms
