// f a0 a1 a2 ...: a0 + sum of a_k cos(k pi l), the Fourier series of the even extension. Both ends are free
// and the terms are orthogonal on [0, 1], so the coefficients are well determined (sines beside the cosines
// are not).
#include <cmath>

#include "core/units.h"
#include "plant/functions/kinds.h"

namespace bpms {
namespace {

class CosineSeries final : public ScaledFunction {
 public:
  using ScaledFunction::ScaledFunction;
  char code() const override { return 'f'; }
  double value(double l) const override {
    double sum = 0;
    for (std::size_t k = 0; k < numbers_.size(); ++k)
      sum += numbers_[k] * std::cos(static_cast<double>(k) * pi * l);
    return scale_ * sum;
  }
  double derivative(double l) const override {
    double sum = 0;
    for (std::size_t k = 1; k < numbers_.size(); ++k) {
      const double rate = static_cast<double>(k) * pi;
      sum -= rate * numbers_[k] * std::sin(rate * l);
    }
    return scale_ * sum;
  }
  std::unique_ptr<OrganFunction> clone() const override { return std::make_unique<CosineSeries>(*this); }
  int coefficients() const override { return static_cast<int>(numbers_.size()); }
  void basis(double l, double* out) const override {
    for (std::size_t k = 0; k < numbers_.size(); ++k)
      out[k] = scale_ * std::cos(static_cast<double>(k) * pi * l);
  }
  std::unique_ptr<OrganFunction> with_coefficients(const std::vector<double>& values) const override {
    return std::make_unique<CosineSeries>(values, scale_);
  }
};

std::unique_ptr<OrganFunction> make_cosine_series(std::vector<double> numbers, double scale,
                                                  const SourceLocation&) {
  return std::make_unique<CosineSeries>(std::move(numbers), scale);
}

}  // namespace

OrganFunctionKind cosine_series_kind() {
  return {'f', "cosine series", "coefficients a0 a1 a2 ... of 1 cos(pi l) cos(2 pi l) ...",
          make_cosine_series, zero_coefficients};
}

}  // namespace bpms
