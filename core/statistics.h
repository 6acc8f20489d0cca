// Order statistics and constants of robust estimation.
#pragma once
#include <utility>
#include <vector>

namespace bpms {

// Between the two values nearest to the part `q` of the way up, linearly; NaN of nothing.
double quantile(std::vector<double> values, double q);
inline double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

// Width of Cauchy's loss in sigmas: 95 % efficient on normal residuals (Holland & Welsch 1977).
inline constexpr double cauchy_sigmas = 2.385;

}  // namespace bpms
