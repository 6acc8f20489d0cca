#include "calibrate/adjustment/outliers.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"

namespace bpms {
namespace {

constexpr double corner_sigmas = 6;       // a corner farther off is out (of normal ones 1 in 65 million)
constexpr double garbage_share = 0.5;     // a view with more of its corners out is out as a whole
constexpr double view_rms_of_median = 4;  // a view is called an outlier above this many times the median rms
constexpr double least_sigma_px = 1e-6;   // noise-free corners have rounding only

// Marks the corners in use; true when a mark changed.
bool mark(BundleProblem& problem, const BundleState& state, double limit_px, std::size_t views) {
  std::vector<int> all(views, 0), bad(views, 0);
  std::vector<bool> good(problem.corners.size());
  for (std::size_t i = 0; i < problem.corners.size(); ++i) {
    const auto r = residual(problem, state, problem.corners[i]);
    good[i] = problem.corners[i].placed && r && r->norm() <= limit_px;
    const auto view = static_cast<std::size_t>(problem.corners[i].view);
    ++all[view];
    bad[view] += good[i] ? 0 : 1;
  }
  bool changed = false;
  for (std::size_t i = 0; i < problem.corners.size(); ++i) {
    CornerObservation& corner = problem.corners[i];
    const auto view = static_cast<std::size_t>(corner.view);
    const bool use = good[i] && bad[view] <= garbage_share * all[view];
    changed = changed || use != corner.used;
    corner.used = use;
  }
  return changed;
}

void judge_views(const BundleProblem& problem, const BundleState& state, std::size_t views,
                 OutlierSearch& out) {
  std::vector<double> squared(views, 0);
  std::vector<int> count(views, 0);
  for (const CornerObservation& corner : problem.corners) {
    const auto r = residual(problem, state, corner);
    const auto view = static_cast<std::size_t>(corner.view);
    squared[view] += r ? r->squaredNorm() : HUGE_VAL;
    count[view] += 2;
  }
  for (std::size_t v = 0; v < views; ++v)
    out.view_rms_px.push_back(std::sqrt(squared[v] / std::max(count[v], 1)));
  const double limit = view_rms_of_median * std::max(median(out.view_rms_px), least_sigma_px);
  for (const double rms : out.view_rms_px) out.view_out.push_back(rms > limit);
}

}  // namespace

OutlierSearch fit_without_outliers(BundleProblem& problem, int views, BundleState& state) {
  OutlierSearch out;
  for (CornerObservation& corner : problem.corners)
    corner.used = corner.placed && residual(problem, state, corner).has_value();
  constexpr int robust_rounds = 2, most_rounds = 10;
  constexpr double rough = 1e-3;
  for (int round = 0; round < robust_rounds; ++round) {
    const double sigma = std::max(robust_sigma(problem, state), least_sigma_px);
    adjust(problem, {cauchy_sigmas * sigma, rough, 50}, state);
  }
  for (int round = 0; round < most_rounds; ++round) {
    out.sigma_px = std::max(robust_sigma(problem, state), least_sigma_px);
    const bool changed = mark(problem, state, corner_sigmas * out.sigma_px, static_cast<std::size_t>(views));
    if (round > 0 && !changed) break;
    problem.sigma_px = std::max(robust_sigma(problem, state), least_sigma_px);
    out.last = adjust(problem, {}, state);
  }
  judge_views(problem, state, static_cast<std::size_t>(views), out);
  return out;
}

}  // namespace bpms
