// The search for the function with the best evidence among the candidates of a role.
#pragma once
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "fit/leaf_trial.h"

namespace bpms {

using AiccTable = std::vector<std::pair<FunctionChoice, double>>;

// Solves every candidate (nullopt: the points cannot carry it, or it makes no sense) and keeps the one with
// the least AICc; fills the table. nullopt when no candidate is left.
std::optional<FunctionChoice> choose_function(
    const std::vector<FunctionChoice>& candidates, bool errors_known,
    const std::function<std::optional<LeafTrial>(FunctionChoice)>& solve, AiccTable& table);

// Lowers the order of an asked function until the data carry it; false when there is nothing left to lower.
bool lower_order(FunctionChoice& choice);

}  // namespace bpms
