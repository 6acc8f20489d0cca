#include "fit/outliers.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "fit/leaf_trial.h"

namespace bpms {
namespace {

constexpr double limit2 = 25;  // five sigma, squared

// Median of |r|^2 over what it is for normal errors in two dimensions (a point's place takes one of three).
double robust_variance(const CurveSolution& solution, const std::vector<LeafObservation>& observations) {
  std::vector<double> d2;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    if (observations[k].place_free && observations[k].weight > 0) d2.push_back(solution.distance2[k]);
  }
  if (d2.empty()) return 1;
  constexpr double median_chi2_2 = 1.3862943611198906;
  return std::max(1.0, median(std::move(d2)) / median_chi2_2);
}

}  // namespace

std::vector<std::size_t> far_observations(LeafModel& model, std::vector<LeafObservation> observations,
                                          const Eigen::VectorXd& start, int held) {
  constexpr int passes = 8;
  constexpr double cauchy2 = cauchy_sigmas * cauchy_sigmas;
  CurveSolution solution = solve_curves(model, observations, start, held);
  // A bad point bends the plain fit and blows up its scatter: whether to look closer is asked of the stated
  // errors.
  const bool all_near = std::all_of(solution.distance2.begin(), solution.distance2.end(),
                                    [](double d2) { return d2 < limit2; });
  if (!solution.converged || all_near) return {};
  double variance = robust_variance(solution, observations);
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t k = 0; k < observations.size(); ++k) {
      if (observations[k].place_free && observations[k].weight > 0)
        observations[k].weight = 1 / (1 + solution.distance2[k] / (cauchy2 * variance));
    }
    solution = solve_curves(model, observations, solution.parameters, held);
    variance = robust_variance(solution, observations);
  }
  if (!solution.converged) return {};
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const bool asked = observations[k].place_free && observations[k].weight > 0;
    if (asked && solution.distance2[k] > limit2 * variance) out.push_back(k);
  }
  if (out.size() * 5 > observations.size()) return {};
  return out;
}

std::vector<int> remove_outliers(MeasuredOrgan& organ, const FitOptions& options) {
  constexpr std::size_t least_points = 10;
  constexpr FunctionChoice rich_inclination{'s', 5}, rich_azimuth{'p', 2};
  if (organ.midrib.size() < least_points) return {};
  std::string failure;
  const std::optional<LeafProblem> problem = leaf_problem(organ, options, failure);
  if (!problem || !problem->errors_known) return {};
  LeafTrial trial = solve_midrib(*problem, rich_inclination, rich_azimuth);
  const std::vector<std::size_t> far =
      far_observations(trial.model, problem->midrib, trial.solution.parameters, 0);
  std::vector<int> out;
  for (auto k = far.rbegin(); k != far.rend(); ++k) {
    out.insert(out.begin(), organ.midrib[*k].point);
    organ.midrib.erase(organ.midrib.begin() + static_cast<std::ptrdiff_t>(*k));
  }
  return out;
}

}  // namespace bpms
