#include "simulate/forward/share_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "simulate/transport/estimate.h"

namespace bpms {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double most_growth = 16, least_growth = 1.2;
constexpr double steps_an_octave = 8;
constexpr int steps = 4 * 8 + 1;  // of the paths: from as many as now to 16 times

double target_of(const ViewSums::Variances& view, const Sampling& sampling, std::size_t band) {
  return sampling.relative ? sampling.target_se * std::abs(view.value[band]) : sampling.target_se;
}

// Rays a batch that reach the target beside so many paths a batch.
double rays_beside(const ViewSums::Variances& view, const Sampling& sampling, double photons) {
  constexpr double margin = 1.05;  // the standard error is itself uncertain
  double out = 1;
  for (std::size_t b = 0; b < view.ray.size(); ++b) {
    const double target = target_of(view, sampling, b);
    const double left = target * target / margin - view.photon[b] / (photons * batches);
    if (!(left > 0)) return infinite;
    out = std::max(out, view.ray[b] / (left * batches));
  }
  return out;
}

std::uint64_t rounded_up(double count) {
  const auto n = static_cast<std::uint64_t>(std::ceil(count));
  const std::uint64_t step = std::max<std::uint64_t>(1, std::bit_floor(n) / 16);
  return (n + step - 1) / step * step;
}

}  // namespace

bool is_reached(const ViewSums::Variances& view, const Sampling& sampling) {
  for (std::size_t b = 0; b < view.value.size(); ++b)
    if (view.standard_error[b] > target_of(view, sampling, b)) return false;
  return true;
}

std::vector<ViewGoal> plan_views(const std::vector<ViewSums>& views, const Sources& sources,
                                 const ShareCosts& costs) {
  const Sampling& sampling = sources.simulation->sampling;
  const std::uint64_t most = std::max<std::uint64_t>(1, sampling.max_samples / batches);
  std::vector<ViewGoal> out;
  std::uint64_t base = 1;  // paths that are traced already, at most
  for (const ViewSums& view : views) {
    out.push_back({view.rays(), view.photons()});
    base = std::max(base, view.photons());
  }
  const auto paths_at = [&](int step) {
    return static_cast<double>(base) * std::exp2(step / steps_an_octave);
  };
  // Of each view: the cheapest choice among up to so many paths.
  struct Choice {
    double work = infinite, rays = 0, photons = 0;
  };
  std::vector<std::vector<Choice>> best(views.size());
  std::vector<double> work(steps, 0.0);
  for (std::size_t v = 0; v < views.size(); ++v) {
    const ViewSums::Variances known = views[v].variances(sources);
    if (is_reached(known, sampling)) continue;
    const auto done_rays = static_cast<double>(views[v].rays()),
               done_photons = static_cast<double>(views[v].photons());
    Choice least;
    // Fewer paths than have been traced for others are a choice too.
    for (int step = -steps; step < steps; ++step) {
      const double photons = std::max(done_photons, paths_at(step));
      const double rays = std::max(done_rays, rays_beside(known, sampling, photons));
      const double its = costs.ray * rays + costs.look * photons;
      if (its < least.work) least = {its, rays, photons};
      if (step < 0) continue;
      best[v].push_back(least);
    }
    for (int step = 0; step < steps; ++step)
      work[static_cast<std::size_t>(step)] += best[v][static_cast<std::size_t>(step)].work;
  }
  int chosen = steps - 1;
  double least = infinite;
  for (int step = 0; step < steps; ++step) {
    const double all = work[static_cast<std::size_t>(step)] + costs.trace * (paths_at(step) - paths_at(0));
    if (all < least) least = all, chosen = step;
  }
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (best[v].empty()) continue;
    const Choice& choice = best[v][static_cast<std::size_t>(chosen)];
    const auto bounded = [&](std::uint64_t done, double wanted) {
      const auto now = static_cast<double>(done);
      return std::max(done, std::min(most, rounded_up(std::clamp(wanted, now, most_growth * now))));
    };
    const bool hopeless = !(choice.work < infinite);  // with 16 times the paths: come as near as that
    ViewGoal& goal = out[v];
    goal.rays = bounded(goal.rays, hopeless ? most_growth * static_cast<double>(goal.rays) : choice.rays);
    goal.photons = bounded(goal.photons, hopeless ? paths_at(steps - 1) : choice.photons);
    if (goal.rays == views[v].rays() && goal.photons == views[v].photons()) {
      goal.rays = bounded(goal.rays, least_growth * static_cast<double>(goal.rays));
      goal.photons = bounded(goal.photons, least_growth * static_cast<double>(goal.photons));
    }
  }
  return out;
}

}  // namespace bpms
