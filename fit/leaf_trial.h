// One trial of a leaf: a choice of functions, solved. The midrib alone first; then midrib and edges as one
// surface.
#pragma once
#include <vector>

#include "fit/leaf_problem.h"

namespace bpms {

struct LeafTrial {
  LeafModel model;
  CurveSolution solution;
  bool usable() const { return solution.converged && solution.degrees_of_freedom() >= 0; }
};

// How many numbers the observations hold beyond the unknown places of their points.
int numbers_that_count(const std::vector<LeafObservation>& observations);

LeafTrial solve_midrib(const LeafProblem& problem, FunctionChoice inclination, FunctionChoice azimuth);

struct EdgeStart {  // the edges' places, twist and full width there
  std::vector<double> l, twist, width;
};
LeafTrial solve_surface(const LeafProblem& problem, const LeafTrial& midrib, const EdgeStart& edges,
                        FunctionChoice twist, FunctionChoice width);

}  // namespace bpms
