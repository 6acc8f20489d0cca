// Which kind and order of function a fit uses: asked for, or chosen by evidence among bounded candidates.
// Evidence is the corrected Akaike information criterion (Hurvich & Tsai 1989; Burnham & Anderson 2002): with
// known errors chi2 / c + 2 k + 2 k (k + 1) / (n - k - 1), where c >= 1 is chi2 per degree of freedom of the
// richest candidate (quasi-AICc: errors that are larger than stated must not buy coefficients); with unknown
// errors n ln(chi2 / n) in place of chi2 / c, and the error itself counts as a parameter.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/function_basis.h"

namespace bpms {

// What --function asks for; an absent choice is made by evidence.
struct FunctionRequest {
  std::optional<FunctionChoice> inclination, azimuth, twist, width;
};
// "auto", "p:3" (all functions), or "inclination=p:3,azimuth=p:1,width=auto". p:K is the degree, f:K the
// harmonics, n:K and s:K the knots.
FunctionRequest parse_function_request(std::string_view text);

enum class FunctionRole { inclination, azimuth, twist, width };
std::string role_name(FunctionRole role);
// The candidates for a role. Azimuth and twist may also be constant (order 0).
std::vector<FunctionChoice> function_candidates(FunctionRole role);

// chi2 is divided by `inflation` (c above); errors_known false: the other form. +infinity where n <= k + 1.
double corrected_akaike(double chi2, int residuals, int parameters, bool errors_known, double inflation);

}  // namespace bpms
