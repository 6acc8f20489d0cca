// One trial of a leaf: a choice of functions, solved. The midrib alone first; then midrib and edges as one
// surface.
#pragma once
#include <vector>

#include "fit/leaf_problem.h"

namespace bpms {

struct LeafTrial {
  LeafModel model;
  CurveSolution solution;
  double variance_factor =
      1;  // of `solution`'s covariance: chi2 over what is expected of it, where that is above one
  bool usable() const { return solution.converged && solution.degrees_of_freedom() >= 0; }
};

// How many numbers the observations hold beyond the unknown places of their points.
int numbers_that_count(const std::vector<LeafObservation>& observations);

LeafTrial solve_midrib(const LeafProblem& problem, FunctionChoice inclination, FunctionChoice azimuth);

struct EdgeStart {  // the edges' places, twist and full width there
  std::vector<double> l, twist, width;
};
// `solution` is that of the edges: its chi2, and the covariance of twist and width alone.
LeafTrial solve_edges(const LeafProblem& problem, const LeafTrial& midrib, const EdgeStart& edges,
                      FunctionChoice twist, FunctionChoice width);

// chi2 per degree of freedom, not below one where the errors are known; NaN where there is nothing to say.
double variance_factor(double chi2, double degrees_of_freedom, bool errors_known);
// Covariance of all parameters, scaled: the midrib's, and that of twist and width with what they inherit from
// it.
Eigen::MatrixXd midrib_covariance(const LeafProblem& problem, LeafTrial& midrib);
Eigen::MatrixXd surface_covariance(const LeafProblem& problem, const Eigen::MatrixXd& midrib_covariance,
                                   LeafTrial& edges);

}  // namespace bpms
