#include "core/statistics.h"

#include <algorithm>
#include <cmath>

namespace bpms {

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::nan("");
  const double at = q * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::ptrdiff_t>(at);
  const auto lower = values.begin() + low;
  std::nth_element(values.begin(), lower, values.end());
  const double part = at - static_cast<double>(low);
  if (part == 0) return *lower;
  return *lower + part * (*std::min_element(lower + 1, values.end()) - *lower);
}

}  // namespace bpms
