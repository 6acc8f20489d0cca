// The nodes of all batches of a view side by side.
#pragma once
#include <vector>

#include "simulate/transport/interactions.h"

namespace bpms {
InteractionHistogram interaction_histogram(const std::vector<InteractionTally>& batches);
}  // namespace bpms
