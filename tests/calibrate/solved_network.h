// A network solved from nothing but its measurement.
#pragma once
#include "calibrate/adjustment/bundle_adjustment.h"
#include "calibrate/adjustment/normal_equations.h"
#include "calibrate/adjustment/outliers.h"
#include "calibrate/adjustment/synthetic_network.h"
#include "calibrate/adjustment/turntable.h"

namespace bpms::test {

struct SolvedNetwork {
  BundleProblem problem;
  BundleState state;
  NormalEquations equations;
};

inline SolvedNetwork solve(const SyntheticNetwork& network, BundleProblem problem,
                           const std::string& lens = "brown4") {
  SolvedNetwork out{std::move(problem), {}, {}};
  out.state = first_state(out.problem, network.cameras(), lens_choice(lens));
  const int views = out.problem.corners.empty() ? 0 : out.problem.corners.back().view + 1;
  fit_without_outliers(out.problem, views, out.state);
  out.equations = normal_equations(out.problem, out.state);
  return out;
}

}  // namespace bpms::test
