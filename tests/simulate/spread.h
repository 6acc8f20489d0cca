// Mean of independent draws, its standard error from their spread.
#pragma once
#include <cmath>
#include <vector>

namespace bpms::test {

struct Mean {
  double value = 0, error = 0;
};

inline Mean mean_of(const std::vector<double>& draws) {
  const auto n = static_cast<double>(draws.size());
  Mean out;
  double squares = 0;
  for (const double draw : draws) out.value += draw / n;
  for (const double draw : draws) squares += (draw - out.value) * (draw - out.value);
  out.error = std::sqrt(squares / (n * (n - 1)));
  return out;
}

}  // namespace bpms::test
