#include "fit/edge_fit.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "fit/function_search.h"
#include "fit/outliers.h"

namespace bpms {
namespace {

// Where no edge point lies a rich function may run off; one that does is no candidate. Nor is one by which a
// blade widens beyond its last edge point, where it runs out to its tip.
bool stays_near(const LeafTrial& trial, const EdgeStart& edges, bool has_tip) {
  constexpr double wide = 1.5, inside_out = -0.25, turned = pi / 3;
  constexpr int steps = 40;
  const double widest = *std::max_element(edges.width.begin(), edges.width.end());
  const auto [least, most] = std::minmax_element(edges.twist.begin(), edges.twist.end());
  const LeafModelShape& shape = trial.model.shape();
  const Eigen::VectorXd& p = trial.solution.parameters;
  Eigen::VectorXd twist_basis(shape.twist.size()), width_basis(shape.width.size());
  const double last = *std::max_element(edges.l.begin(), edges.l.end());
  shape.width.values(last, width_basis.data());
  const double last_width = width_basis.dot(p.segment(trial.model.at_width(), width_basis.size()));
  for (int k = 0; k <= steps; ++k) {
    shape.twist.values(static_cast<double>(k) / steps, twist_basis.data());
    shape.width.values(static_cast<double>(k) / steps, width_basis.data());
    const double twist = twist_basis.dot(p.segment(trial.model.at_twist(), twist_basis.size()));
    const double width = width_basis.dot(p.segment(trial.model.at_width(), width_basis.size()));
    if (width > wide * widest || width < inside_out * widest || twist < *least - turned ||
        twist > *most + turned)
      return false;
    if (has_tip && k > last * steps && width > last_width) return false;
  }
  return true;
}

void drop_far_points(LeafProblem& problem, const LeafTrial& midrib, const EdgeStart& start) {
  constexpr FunctionChoice twist{'p', 2}, width{'p', 3};
  constexpr std::size_t least_points = 10;
  if (start.l.size() < least_points) return;
  LeafTrial rich = solve_edges(problem, midrib, start, twist, width);
  for (const std::size_t k :
       far_observations(rich.model, problem.edges, rich.solution.parameters, midrib.model.parameters()))
    problem.edges[k].weight = 0;
}

}  // namespace

std::optional<LeafTrial> fit_edges(LeafProblem& problem, const LeafTrial& midrib,
                                   const FunctionRequest& request, OrganFit& out) {
  EdgeStart start;
  out.edges_swapped = edge_start(problem, midrib.model, start.l, start.twist, start.width);
  if (out.edges_swapped)
    out.notes.push_back(
        "by the edges' labels the upper face looked away from the stem at the base: left and right "
        "exchanged");
  if (start.l.empty()) {
    out.notes.push_back("no edge point lies beside the midrib: twist and width left out");
    return std::nullopt;
  }
  if (problem.errors_known) drop_far_points(problem, midrib, start);
  const auto without = std::count_if(problem.edges.begin(), problem.edges.end(),
                                     [](const LeafObservation& o) { return o.weight <= 0; });
  if (without > 0)
    out.notes.push_back(fmt::format("{} of {} edge points left out: far off, or beyond the midrib's ends",
                                    without, problem.edges.size()));
  const int numbers = numbers_that_count(problem.edges);
  const auto solve = [&](FunctionChoice twist, FunctionChoice width) -> std::optional<LeafTrial> {
    if (FunctionBasis(twist, true).size() + FunctionBasis(width, true).size() >= numbers) return std::nullopt;
    return solve_edges(problem, midrib, start, twist, width);
  };
  const auto sensible = [&](FunctionChoice twist, FunctionChoice width) {
    std::optional<LeafTrial> trial = solve(twist, width);
    return trial && stays_near(*trial, start, out.measured.organ == "leaf") ? trial : std::nullopt;
  };
  FunctionChoice twist = request.twist.value_or(FunctionChoice{'p', 1});
  FunctionChoice width = request.width.value_or(FunctionChoice{'p', 2});
  if (!request.width) {
    const auto best = choose_function(
        function_candidates(FunctionRole::width), problem.errors_known,
        [&](FunctionChoice c) { return sensible(twist, c); }, out.aicc_table["width"]);
    if (best) width = *best;
  }
  if (!request.twist) {
    const auto best = choose_function(
        function_candidates(FunctionRole::twist), problem.errors_known,
        [&](FunctionChoice c) { return sensible(c, width); }, out.aicc_table["twist"]);
    if (best) twist = *best;
  }
  // A function that was asked for is given as long as the points carry it, one that was chosen must make
  // sense too.
  const bool asked = request.twist && request.width;
  std::optional<LeafTrial> trial = asked ? solve(twist, width) : sensible(twist, width);
  while (!trial && (lower_order(width) || lower_order(twist)))
    trial = asked ? solve(twist, width) : sensible(twist, width);
  if (trial && trial->usable()) return trial;
  out.notes.push_back("the edges could not be fitted: twist and width left out");
  return std::nullopt;
}

}  // namespace bpms
