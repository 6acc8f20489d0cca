// The table row of a kind of organ function, and what the kinds share.
#pragma once
#include <span>
#include <string_view>

#include "plant/organ_function.h"

namespace bpms {

struct OrganFunctionKind {
  char code;
  std::string_view name;
  std::string_view layout;  // what stands behind the code, in words
  std::unique_ptr<OrganFunction> (*make)(std::vector<double> numbers, double scale,
                                         const SourceLocation& where);
  std::vector<double> (*blank)(int order);  // numbers of the function with all coefficients zero
};

// The pairs l1 v1 l2 v2 ... of the kinds that go through knots: at least two, l rising strictly from 0 to 1.
void require_knots(char code, const std::vector<double>& numbers, const SourceLocation& where);
std::vector<double> even_knots(int count);         // l evenly spread, values zero
std::vector<double> zero_coefficients(int order);  // of the series: order + 1 of them
// Index i of the interval [l_i, l_i+1) that holds l; the first or the last one outside.
std::size_t knot_interval(std::span<const double> knots, double l);

// What all kinds do alike: keep the numbers and the scale.
class ScaledFunction : public OrganFunction {
 public:
  ScaledFunction(std::vector<double> numbers, double scale) : numbers_(std::move(numbers)), scale_(scale) {}
  const std::vector<double>& numbers() const final { return numbers_; }

 protected:
  std::vector<double> numbers_;
  double scale_;
};

}  // namespace bpms
