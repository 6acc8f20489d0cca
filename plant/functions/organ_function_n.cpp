// n l1 v1 l2 v2 ...: linear between the pairs. The coefficients are the values at the knots.
#include "plant/functions/kinds.h"

namespace bpms {
namespace {

class PiecewiseLinear final : public ScaledFunction {
 public:
  PiecewiseLinear(std::vector<double> numbers, double scale) : ScaledFunction(std::move(numbers), scale) {
    for (std::size_t i = 0; i < numbers_.size(); i += 2) knots_.push_back(numbers_[i]);
  }
  char code() const override { return 'n'; }
  double value(double l) const override {
    const std::size_t i = knot_interval(knots_, l);
    const double t = (l - knots_[i]) / (knots_[i + 1] - knots_[i]);
    return scale_ * ((1 - t) * at(i) + t * at(i + 1));
  }
  double derivative(double l) const override {
    const std::size_t i = knot_interval(knots_, l);
    return scale_ * (at(i + 1) - at(i)) / (knots_[i + 1] - knots_[i]);
  }
  std::unique_ptr<OrganFunction> clone() const override { return std::make_unique<PiecewiseLinear>(*this); }
  std::vector<double> breaks() const override { return {knots_.begin() + 1, knots_.end() - 1}; }
  int coefficients() const override { return static_cast<int>(knots_.size()); }
  void basis(double l, double* out) const override {
    const std::size_t i = knot_interval(knots_, l);
    const double t = (l - knots_[i]) / (knots_[i + 1] - knots_[i]);
    for (std::size_t k = 0; k < knots_.size(); ++k) out[k] = 0;
    out[i] = scale_ * (1 - t);
    out[i + 1] = scale_ * t;
  }
  std::unique_ptr<OrganFunction> with_coefficients(const std::vector<double>& values) const override {
    std::vector<double> numbers = numbers_;
    for (std::size_t i = 0; i < knots_.size(); ++i) numbers[2 * i + 1] = values.at(i);
    return std::make_unique<PiecewiseLinear>(std::move(numbers), scale_);
  }

 private:
  double at(std::size_t knot) const { return numbers_[2 * knot + 1]; }
  std::vector<double> knots_;
};

std::unique_ptr<OrganFunction> make_piecewise_linear(std::vector<double> numbers, double scale,
                                                     const SourceLocation& where) {
  require_knots('n', numbers, where);
  return std::make_unique<PiecewiseLinear>(std::move(numbers), scale);
}

}  // namespace

OrganFunctionKind piecewise_linear_kind() {
  return {'n', "piecewise linear", "pairs l value, l rising from 0 to 1", make_piecewise_linear, even_knots};
}

}  // namespace bpms
