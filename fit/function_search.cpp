#include "fit/function_search.h"

#include <algorithm>
#include <limits>

namespace bpms {

std::optional<FunctionChoice> choose_function(
    const std::vector<FunctionChoice>& candidates, bool errors_known,
    const std::function<std::optional<LeafTrial>(FunctionChoice)>& solve, AiccTable& table) {
  struct Tried {
    FunctionChoice choice;
    double chi2;
    int parameters, residuals;
  };
  std::vector<Tried> tried;
  for (const FunctionChoice& choice : candidates) {
    const std::optional<LeafTrial> trial = solve(choice);
    if (!trial || !trial->usable()) continue;
    const CurveSolution& s = trial->solution;
    tried.push_back({choice, s.chi2, static_cast<int>(s.covariance.rows()), s.residuals});
  }
  double inflation = 1;
  int richest = 0;
  for (const Tried& t : tried) {
    if (t.parameters <= richest || t.residuals <= t.parameters) continue;
    richest = t.parameters;
    inflation = std::max(1.0, t.chi2 / (t.residuals - t.parameters));
  }
  std::optional<FunctionChoice> best;
  double least = std::numeric_limits<double>::infinity();
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

bool lower_order(FunctionChoice& choice) {
  const int least = choice.code == 'n' || choice.code == 's' ? 2 : 0;
  if (choice.order > least) {
    --choice.order;
    return true;
  }
  if (choice.order == 0) return false;
  choice = {'p', 0};
  return true;
}

}  // namespace bpms
