// p c0 c1 c2 ...: the power series sum of c_k l^k.
#include "plant/functions/kinds.h"

namespace bpms {
namespace {

class PowerSeries final : public ScaledFunction {
 public:
  using ScaledFunction::ScaledFunction;
  char code() const override { return 'p'; }
  double value(double l) const override {
    double sum = 0;
    for (std::size_t k = numbers_.size(); k-- > 0;) sum = sum * l + numbers_[k];
    return scale_ * sum;
  }
  double derivative(double l) const override {
    double sum = 0;
    for (std::size_t k = numbers_.size(); k-- > 1;) sum = sum * l + static_cast<double>(k) * numbers_[k];
    return scale_ * sum;
  }
  std::unique_ptr<OrganFunction> clone() const override { return std::make_unique<PowerSeries>(*this); }
  int coefficients() const override { return static_cast<int>(numbers_.size()); }
  void basis(double l, double* out) const override {
    double power = scale_;
    for (std::size_t k = 0; k < numbers_.size(); ++k, power *= l) out[k] = power;
  }
  std::unique_ptr<OrganFunction> with_coefficients(const std::vector<double>& values) const override {
    return std::make_unique<PowerSeries>(values, scale_);
  }
};

std::unique_ptr<OrganFunction> make_power_series(std::vector<double> numbers, double scale,
                                                 const SourceLocation&) {
  return std::make_unique<PowerSeries>(std::move(numbers), scale);
}

}  // namespace

OrganFunctionKind power_series_kind() {
  return {'p', "power series", "coefficients c0 c1 c2 ... of 1 l l^2 ...", make_power_series,
          zero_coefficients};
}

}  // namespace bpms
