#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/parallel.h"
#include "core/progress.h"
#include "core/units.h"
#include "fit/fit.h"
#include "fit/leaf_trial.h"
#include "fit/outliers.h"

namespace bpms {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// Solves every candidate and keeps the one with the best evidence; fills the table.
template <class Solve>
std::optional<FunctionChoice> choose(const std::vector<FunctionChoice>& candidates, int residuals,
                                     bool errors_known, const Solve& solve,
                                     std::vector<std::pair<FunctionChoice, double>>& table) {
  struct Tried {
    FunctionChoice choice;
    double chi2;
    int parameters, residuals;
  };
  std::vector<Tried> tried;
  for (const FunctionChoice& choice : candidates) {
    const std::optional<LeafTrial> trial = solve(choice, residuals);
    if (trial && trial->usable())
      tried.push_back({choice, trial->solution.chi2, static_cast<int>(trial->solution.parameters.size()),
                       trial->solution.residuals});
  }
  double inflation = 1;
  int richest = 0;
  for (const Tried& t : tried) {
    if (t.parameters <= richest || t.residuals <= t.parameters) continue;
    richest = t.parameters;
    inflation = std::max(1.0, t.chi2 / (t.residuals - t.parameters));
  }
  std::optional<FunctionChoice> best;
  double least = infinity;
  for (const Tried& t : tried) {
    const double aicc = corrected_akaike(t.chi2, t.residuals, t.parameters, errors_known, inflation);
    table.emplace_back(t.choice, aicc);
    if (aicc < least) {
      least = aicc;
      best = t.choice;
    }
  }
  return best;
}

// Lowers the order of an asked function until the data carry it; false when there is nothing left to lower.
bool lower(FunctionChoice& choice) {
  const int least = choice.code == 'n' || choice.code == 's' ? 2 : 0;
  if (choice.order <= least) {
    if (choice.order == 0) return false;
    choice = {'p', 0};
    return true;
  }
  --choice.order;
  return true;
}

FittedFunction fitted_function(const FunctionBasis& basis, const CurveSolution& solution, int at, double unit,
                               double variance_factor) {
  FittedFunction out;
  out.basis = basis;
  out.choice = basis.choice();
  const Eigen::MatrixXd& t = basis.transform();
  out.coefficients = unit * t * solution.parameters.segment(at, basis.size());
  out.covariance = unit * unit * variance_factor * t *
                   solution.covariance.block(at, at, basis.size(), basis.size()) * t.transpose();
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

void set_result(const LeafProblem& problem, const LeafTrial& trial, OrganFit& out) {
  const CurveSolution& solution = trial.solution;
  const LeafModel& model = trial.model;
  const LeafModelShape& shape = model.shape();
  const double scale = problem.scale_m;
  out.errors_known = problem.errors_known;
  out.chi2 = solution.chi2;
  out.degrees_of_freedom = solution.degrees_of_freedom();
  const double per_dof = out.degrees_of_freedom > 0 ? solution.chi2 / out.degrees_of_freedom : nan;
  double factor = per_dof;
  if (problem.errors_known) {
    if (out.degrees_of_freedom > 0) out.chi2_per_dof = per_dof;
    factor = out.degrees_of_freedom > 0 ? std::max(1.0, per_dof) : 1.0;
  }
  if (!solution.full_rank) {
    factor = nan;
    out.notes.push_back("the points do not determine all of the leaf's parameters: no standard errors");
  }
  out.variance_factor = factor;
  if (!problem.errors_known)
    out.sigma_m = scale * std::sqrt(factor) / problem.midrib.front().whitening.col(0).norm();
  out.length_m = scale * solution.parameters[LeafModel::at_length()];
  out.length_sigma_m = scale * std::sqrt(factor * solution.covariance(0, 0));
  out.direction = shape.direction_free ? solution.parameters[model.at_direction()] : shape.direction;
  out.direction -= 2 * pi * std::round(out.direction / (2 * pi));
  out.direction_sigma =
      shape.direction_free
          ? std::sqrt(factor * solution.covariance(model.at_direction(), model.at_direction()))
          : nan;
  out.base_m = scale * shape.base;
  for (std::size_t i = 0; i < shape.base_axes.size(); ++i) {
    const int at_i = model.at_base() + static_cast<int>(i);
    out.base_m[shape.base_axes[i]] += scale * solution.parameters[at_i];
    for (std::size_t j = 0; j < shape.base_axes.size(); ++j)
      out.base_covariance_m2(shape.base_axes[i], shape.base_axes[j]) =
          scale * scale * factor * solution.covariance(at_i, model.at_base() + static_cast<int>(j));
  }
  const auto keep = [&](FunctionRole role, const FunctionBasis& basis, int at, double unit) {
    if (basis.size() == 0) return;
    FittedFunction function = fitted_function(basis, solution, at, unit, factor);
    function.aicc = corrected_akaike(solution.chi2, solution.residuals,
                                     static_cast<int>(solution.parameters.size()), problem.errors_known, 1);
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
    if (azimuth.order >= inclination.order && lower(azimuth)) continue;
    if (!lower(inclination) && !lower(azimuth)) break;
  }
  const auto midrib_candidate = [&](FunctionChoice i, FunctionChoice a) -> std::optional<LeafTrial> {
    if (count(i, a) >= midrib_numbers) return std::nullopt;
    return solve_midrib(*problem, i, a);
  };
  if (!options.functions.inclination) {
    const auto best = choose(
        function_candidates(FunctionRole::inclination), midrib_numbers, problem->errors_known,
        [&](FunctionChoice c, int) { return midrib_candidate(c, azimuth); }, out.aicc_table["inclination"]);
    if (best) inclination = *best;
  } else if (!(inclination == asked_inclination)) {
    out.notes.push_back(fmt::format("too few points for inclination {}: {} fitted", asked_inclination.str(),
                                    inclination.str()));
  }
  if (has_azimuth && !options.functions.azimuth) {
    const auto best = choose(
        function_candidates(FunctionRole::azimuth), midrib_numbers, problem->errors_known,
        [&](FunctionChoice c, int) { return midrib_candidate(inclination, c); }, out.aicc_table["azimuth"]);
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
  if (!problem->edges.empty()) {
    EdgeStart edges;
    out.edges_swapped = edge_start(*problem, trial.model, edges.l, edges.twist, edges.width);
    if (out.edges_swapped)
      out.notes.push_back(
          "by the edges' labels the upper face looked away from the stem at the base: left and right "
          "exchanged");
    const int numbers = midrib_numbers + numbers_that_count(problem->edges);
    const LeafTrial midrib = trial;
    const auto surface = [&](FunctionChoice t, FunctionChoice w) -> std::optional<LeafTrial> {
      const int parameters =
          midrib.model.parameters() + FunctionBasis(t, true).size() + FunctionBasis(w, true).size();
      if (parameters >= numbers) return std::nullopt;
      return solve_surface(*problem, midrib, edges, t, w);
    };
    FunctionChoice twist = options.functions.twist.value_or(FunctionChoice{'p', 1});
    FunctionChoice width = options.functions.width.value_or(FunctionChoice{'p', 3});
    if (!options.functions.width) {
      const auto best = choose(
          function_candidates(FunctionRole::width), numbers, problem->errors_known,
          [&](FunctionChoice c, int) { return surface(twist, c); }, out.aicc_table["width"]);
      if (best) width = *best;
    }
    if (!options.functions.twist) {
      const auto best = choose(
          function_candidates(FunctionRole::twist), numbers, problem->errors_known,
          [&](FunctionChoice c, int) { return surface(c, width); }, out.aicc_table["twist"]);
      if (best) twist = *best;
    }
    std::optional<LeafTrial> joint = surface(twist, width);
    while (!joint && (lower(width) || lower(twist))) joint = surface(twist, width);
    if (joint && joint->usable()) {
      trial = std::move(*joint);
    } else {
      out.notes.push_back("the edges could not be fitted: twist and width left out");
    }
  }
  set_result(*problem, trial, out);
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
    out[k] = fit_organ(organs[k], options);
    progress.add();
  });
  return out;
}

}  // namespace bpms
