// The report of a fit: the keys of docs/formats.md; a number with no value is null.
#pragma once
#include "core/json.h"
#include "fit/plant_assembly.h"

namespace bpms {

Json fit_summary(const std::vector<OrganFit>& fits);
// `plants` say which organ of which plant each fit became.
Json fit_report(const std::vector<OrganFit>& fits, const std::vector<FittedPlant>& plants);

}  // namespace bpms
