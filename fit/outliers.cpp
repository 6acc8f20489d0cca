#include "fit/outliers.h"

#include <algorithm>
#include <cmath>

#include "fit/leaf_trial.h"

namespace bpms {
namespace {

constexpr double limit2 = 25;  // five sigma, squared

// Median of |r|^2 over what it is for normal errors in two dimensions (a point's place takes one of three).
double robust_variance(const CurveSolution& solution, const std::vector<LeafObservation>& observations) {
  std::vector<double> d2;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    if (observations[k].place_free) d2.push_back(solution.distance2[k]);
  }
  std::nth_element(d2.begin(), d2.begin() + static_cast<std::ptrdiff_t>(d2.size() / 2), d2.end());
  constexpr double median_chi2_2 = 1.3862943611198906;
  return std::max(1.0, d2[d2.size() / 2] / median_chi2_2);
}

}  // namespace

std::vector<int> remove_outliers(MeasuredOrgan& organ, const FitOptions& options) {
  constexpr std::size_t least_points = 10;
  constexpr FunctionChoice rich_inclination{'s', 5}, rich_azimuth{'p', 2};
  constexpr int passes = 8;
  if (organ.midrib.size() < least_points) return {};
  std::string failure;
  std::optional<LeafProblem> problem = leaf_problem(organ, options, failure);
  if (!problem || !problem->errors_known) return {};
  LeafTrial trial = solve_midrib(*problem, rich_inclination, rich_azimuth);
  double variance = robust_variance(trial.solution, problem->midrib);
  const auto far = [&](std::size_t k) {
    return problem->midrib[k].place_free && trial.solution.distance2[k] > limit2 * variance;
  };
  // A bad point bends the plain fit and blows up its scatter: whether to look closer is asked of the stated
  // errors.
  const std::vector<double>& distance2 = trial.solution.distance2;
  if (!trial.solution.converged || *std::max_element(distance2.begin(), distance2.end()) < limit2) return {};
  // Cauchy's weights, their scale from the median: the far points let go of the curve.
  for (int pass = 0; pass < passes; ++pass) {
    constexpr double cauchy2 = 2.385 * 2.385;
    for (std::size_t k = 0; k < problem->midrib.size(); ++k) {
      if (problem->midrib[k].place_free)
        problem->midrib[k].weight = 1 / (1 + trial.solution.distance2[k] / (cauchy2 * variance));
    }
    trial.solution = solve_curves(trial.model, problem->midrib, trial.solution.parameters);
    variance = robust_variance(trial.solution, problem->midrib);
  }
  if (!trial.solution.converged) return {};
  std::vector<int> out;
  std::vector<VectorPoint> kept;
  for (std::size_t k = 0; k < organ.midrib.size(); ++k) {
    if (far(k))
      out.push_back(organ.midrib[k].point);
    else
      kept.push_back(organ.midrib[k]);
  }
  // When much of the leaf is "wrong", the function is, or the errors are: nothing is thrown away.
  if (out.size() * 5 > organ.midrib.size()) return {};
  organ.midrib = kept;
  return out;
}

}  // namespace bpms
