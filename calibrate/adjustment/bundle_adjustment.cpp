#include "calibrate/adjustment/bundle_adjustment.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>

#include "calibrate/adjustment/blocks.h"

namespace bpms {
namespace {

using Kind = BlockId::Kind;

// Blocks that no two of share a term, most of all: they are eliminated first.
Kind eliminated_first(const std::map<BlockId, Block>& blocks, const BundleProblem& problem) {
  const bool nature = std::any_of(problem.targets.begin(), problem.targets.end(),
                                  [](const NetworkTarget& t) { return t.known == PointsKnown::unknown; });
  if (nature) return Kind::point;
  const auto held = [&](const auto& entry) {
    return entry.first.kind == Kind::target && problem.slots(entry.first.a) > 1;
  };
  if (problem.rig_moves && !problem.turntable() && std::none_of(blocks.begin(), blocks.end(), held))
    return Kind::rig;
  return Kind::target;
}

ceres::Solver::Options solver_settings(const BundleProblem& problem, const AdjustOptions& options,
                                       const std::map<BlockId, Block>& blocks) {
  ceres::Solver::Options out;
  out.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  const Kind first = eliminated_first(blocks, problem);
  int eliminated = 0, rest = 0;
  for (const auto& [id, block] : blocks) {
    const bool now =
        id.kind == first && (first != Kind::target || problem.slots(id.a) > 1 || blocks.size() < 4);
    out.linear_solver_ordering->AddElementToGroup(block.values, now ? 0 : 1);
    (now ? eliminated : rest) += block.size;
  }
  constexpr int dense = 600;
  out.linear_solver_type = eliminated == 0 || rest == 0 ? ceres::SPARSE_NORMAL_CHOLESKY
                           : rest < dense               ? ceres::DENSE_SCHUR
                                                        : ceres::SPARSE_SCHUR;
  if (eliminated == 0 || rest == 0) out.linear_solver_ordering.reset();
  out.max_num_iterations = options.most_iterations;
  out.max_num_consecutive_invalid_steps = 50;
  out.function_tolerance = options.tolerance;
  out.parameter_tolerance = 1e-13;
  out.gradient_tolerance = 1e-13;
  out.num_threads = 1;  // sums in one order: the same bits on every machine
  out.logging_type = ceres::SILENT;
  return out;
}

}  // namespace

AdjustResult adjust(const BundleProblem& problem, const AdjustOptions& options, BundleState& state) {
  // A rejected step is no news for the user. Set once: adjustments run side by side.
  [[maybe_unused]] static const int silent = FLAGS_minloglevel = google::GLOG_FATAL;
  Blocks blocks(problem, state);
  ceres::Problem::Options ownership;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::CauchyLoss loss(options.cauchy_px > 0 ? options.cauchy_px : 1);
  ceres::Problem ceres_problem(ownership);
  for (const auto& [id, block] : blocks.all()) {
    ceres_problem.AddParameterBlock(block.values, block.size);
    if (static_cast<int>(block.held.size()) == block.size)
      ceres_problem.SetParameterBlockConstant(block.values);
    else if (!block.held.empty())
      ceres_problem.SetManifold(block.values, new ceres::SubsetManifold(block.size, block.held));
  }
  for (const Term& term : blocks.terms()) {
    std::vector<double*> values;
    for (const BlockId& id : term.blocks) values.push_back(blocks.all().at(id).values);
    ceres_problem.AddResidualBlock(term.cost.get(),
                                   options.cauchy_px > 0 && term.corner >= 0 ? &loss : nullptr, values);
  }
  if (blocks.terms().empty()) return {true, 0};
  ceres::Solver::Summary summary;
  ceres::Solve(solver_settings(problem, options, blocks.all()), &ceres_problem, &summary);
  blocks.store();
  return {summary.termination_type == ceres::CONVERGENCE, static_cast<int>(summary.iterations.size())};
}

}  // namespace bpms
