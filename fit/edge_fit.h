// Twist and width from the points of the two edges, the midrib being known.
#pragma once
#include <optional>

#include "fit/leaf_trial.h"

namespace bpms {

// Chooses the functions that were not asked for, says in `out` what was done. nullopt when the edges cannot
// be fitted.
std::optional<LeafTrial> fit_edges(LeafProblem& problem, const LeafTrial& midrib,
                                   const FunctionRequest& request, OrganFit& out);

}  // namespace bpms
