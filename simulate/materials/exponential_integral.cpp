#include "simulate/materials/exponential_integral.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace bpms {

double exponential_integral(double x) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  if (x <= 1) {
    double sum = -std::numbers::egamma - std::log(x), term = 1;
    for (int n = 1; n < 100; ++n) {
      term *= -x / n;
      sum -= term / n;
      if (std::abs(term) < epsilon * std::abs(sum)) break;
    }
    return sum;
  }
  // exp(-x) / (x + 1 - 1 / (x + 3 - 4 / (x + 5 - ...))), by Lentz's method.
  double b = x + 1, c = std::numeric_limits<double>::infinity(), d = 1 / b, value = d;
  for (int n = 1; n < 1000; ++n) {
    const double a = -static_cast<double>(n) * n;
    b += 2;
    d = 1 / (a * d + b);
    c = b + a / c;
    value *= c * d;
    if (std::abs(c * d - 1) < epsilon) break;
  }
  return value * std::exp(-x);
}

}  // namespace bpms
