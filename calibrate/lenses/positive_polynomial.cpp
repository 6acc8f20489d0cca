#include "calibrate/lenses/positive_polynomial.h"

namespace bpms {
namespace {

constexpr std::size_t degree = polynomial_degree;

// Bernstein coefficients on [0, 1]: the polynomial lies in their convex hull, and the two at the ends are its
// values. Halving until all are positive (yes) or an end is not (no) decides; a double root never does, and
// counts as no.
bool positive(const Polynomial& bernstein, int depth) {
  if (!(bernstein.front() > 0 && bernstein.back() > 0)) return false;
  bool all = true;
  for (const double b : bernstein) all = all && b > 0;
  if (all) return true;
  if (depth == 0) return false;
  Polynomial left = bernstein, right = bernstein;
  for (std::size_t step = 1; step <= degree; ++step) {  // de Casteljau at 1/2
    for (std::size_t i = 0; i + step <= degree; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
    left[step] = right[0];
  }
  return positive(left, depth - 1) && positive(right, depth - 1);
}

}  // namespace

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial out{};
  for (std::size_t i = 0; i <= degree; ++i) {
    for (std::size_t j = 0; i + j <= degree; ++j) out[i + j] += a[i] * b[j];
  }
  return out;
}

Polynomial scaled_derivative(Polynomial a) {
  for (std::size_t i = 0; i <= degree; ++i) a[i] *= static_cast<double>(i);
  return a;
}

bool positive_up_to(Polynomial a, double s) {
  double power = 1;
  for (double& c : a) c *= power, power *= s;
  constexpr double binomial[degree + 1][degree + 1] = {
      {1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}, {1, 5, 10, 10, 5, 1}, {1, 6, 15, 20, 15, 6, 1}};
  Polynomial bernstein{};
  for (std::size_t i = 0; i <= degree; ++i) {
    for (std::size_t j = 0; j <= i; ++j) bernstein[i] += binomial[i][j] / binomial[degree][j] * a[j];
  }
  constexpr int halvings = 30;
  return positive(bernstein, halvings);
}

}  // namespace bpms
