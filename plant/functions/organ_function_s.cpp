// s l1 v1 l2 v2 ...: the natural cubic spline through the pairs (second derivative zero at both ends).
// The coefficients are the values at the knots; the second derivatives there are linear in them.
#include <Eigen/LU>

#include "plant/functions/kinds.h"

namespace bpms {
namespace {

// Second derivatives at the knots = matrix * values (de Boor's tridiagonal system, solved once).
Eigen::MatrixXd second_derivative_matrix(const std::vector<double>& knots) {
  const auto n = static_cast<Eigen::Index>(knots.size());
  Eigen::MatrixXd left = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double before = knots[k] - knots[k - 1];
    const double after = knots[k + 1] - knots[k];
    left.row(i).segment(i - 1, 3) << before / 6, (before + after) / 3, after / 6;
    right.row(i).segment(i - 1, 3) << 1 / before, -1 / before - 1 / after, 1 / after;
  }
  return left.partialPivLu().solve(right);
}

class CubicSpline final : public ScaledFunction {
 public:
  CubicSpline(std::vector<double> numbers, double scale) : ScaledFunction(std::move(numbers), scale) {
    for (std::size_t i = 0; i < numbers_.size(); i += 2) knots_.push_back(numbers_[i]);
    second_of_values_ = second_derivative_matrix(knots_);
    set_second();
  }
  char code() const override { return 's'; }
  double value(double l) const override {
    const Weights w = weights(l);
    return scale_ * (w.a * at(w.i) + w.b * at(w.i + 1) + w.c * second(w.i) + w.d * second(w.i + 1));
  }
  double derivative(double l) const override {
    const Weights w = weights(l);
    const double slope = (at(w.i + 1) - at(w.i)) / w.h;
    return scale_ *
           (slope + w.h / 6 * ((1 - 3 * w.a * w.a) * second(w.i) + (3 * w.b * w.b - 1) * second(w.i + 1)));
  }
  std::unique_ptr<OrganFunction> clone() const override { return std::make_unique<CubicSpline>(*this); }
  std::vector<double> breaks() const override { return {knots_.begin() + 1, knots_.end() - 1}; }
  int coefficients() const override { return static_cast<int>(knots_.size()); }
  void basis(double l, double* out) const override {
    const Weights w = weights(l);
    const auto i = static_cast<Eigen::Index>(w.i);
    for (std::size_t k = 0; k < knots_.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      out[k] = scale_ * (w.c * second_of_values_(i, column) + w.d * second_of_values_(i + 1, column));
    }
    out[w.i] += scale_ * w.a;
    out[w.i + 1] += scale_ * w.b;
  }
  std::unique_ptr<OrganFunction> with_coefficients(const std::vector<double>& values) const override {
    auto out = std::make_unique<CubicSpline>(*this);
    for (std::size_t i = 0; i < knots_.size(); ++i) out->numbers_[2 * i + 1] = values.at(i);
    out->set_second();
    return out;
  }

 private:
  struct Weights {
    std::size_t i;
    double h, a, b, c, d;
  };
  Weights weights(double l) const {
    const std::size_t i = knot_interval(knots_, l);
    const double h = knots_[i + 1] - knots_[i];
    const double b = (l - knots_[i]) / h;
    const double a = 1 - b;
    return {i, h, a, b, (a * a * a - a) * h * h / 6, (b * b * b - b) * h * h / 6};
  }
  double at(std::size_t knot) const { return numbers_[2 * knot + 1]; }
  double second(std::size_t knot) const { return second_[static_cast<Eigen::Index>(knot)]; }
  void set_second() {
    Eigen::VectorXd values(static_cast<Eigen::Index>(knots_.size()));
    for (std::size_t i = 0; i < knots_.size(); ++i) values[static_cast<Eigen::Index>(i)] = at(i);
    second_ = second_of_values_ * values;
  }
  std::vector<double> knots_;
  Eigen::MatrixXd second_of_values_;
  Eigen::VectorXd second_;
};

std::unique_ptr<OrganFunction> make_cubic_spline(std::vector<double> numbers, double scale,
                                                 const SourceLocation& where) {
  require_knots('s', numbers, where);
  return std::make_unique<CubicSpline>(std::move(numbers), scale);
}

}  // namespace

OrganFunctionKind cubic_spline_kind() {
  return {'s', "natural cubic spline", "pairs l value, l rising from 0 to 1", make_cubic_spline, even_knots};
}

}  // namespace bpms
