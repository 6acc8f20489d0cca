// Pearson's chi-square of counts against what is expected of them.
#pragma once
#include <cmath>
#include <vector>

namespace bpms::test {

struct ChiSquare {
  double value = 0;
  double freedom = -1;  // the total is given
  // As a standard normal deviate: the cube root of chi-square is nearly normal (Wilson & Hilferty 1931).
  double z() const {
    const double spread = 2 / (9 * freedom);
    return (std::cbrt(value / freedom) - (1 - spread)) / std::sqrt(spread);
  }
};

// Classes with fewer than 5 expected are put together with those that follow.
inline ChiSquare chi_square(const std::vector<double>& counts, const std::vector<double>& expected) {
  ChiSquare out;
  double count = 0, mean = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    count += counts[i], mean += expected[i];
    if (mean < 5) continue;
    out.value += (count - mean) * (count - mean) / mean;
    ++out.freedom;
    count = mean = 0;
  }
  return out;
}

}  // namespace bpms::test
