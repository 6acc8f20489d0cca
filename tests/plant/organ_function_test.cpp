#include "plant/organ_function.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/units.h"
#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;
const SourceLocation here{"x.bpms", 3, 7};

std::unique_ptr<OrganFunction> make(char code, std::vector<double> numbers, double scale = 1) {
  return make_organ_function(code, std::move(numbers), scale, here);
}

struct Example {
  char code;
  std::vector<double> numbers;
};
const Example examples[] = {
    {'n', {0, 5, 0.3, -20, 0.31, 80, 1, 40}},
    {'p', {15, 40, 30, -7}},
    {'f', {10, -10, 3, 0.5}},
    {'s', {0, 5, 0.25, 30, 0.6, -10, 1, 90}},
};

TEST(OrganFunction, PiecewiseLinearGoesThroughItsPairs) {
  const auto f = make('n', {0, 0, 0.5, 60, 1, 180});
  EXPECT_DOUBLE_EQ(f->value(0), 0);
  EXPECT_DOUBLE_EQ(f->value(0.25), 30);
  EXPECT_DOUBLE_EQ(f->value(0.5), 60);
  EXPECT_DOUBLE_EQ(f->value(0.75), 120);
  EXPECT_DOUBLE_EQ(f->value(1), 180);
  EXPECT_EQ(f->breaks(), std::vector<double>{0.5});
}

TEST(OrganFunction, PowerSeriesIsAPolynomial) {
  EXPECT_DOUBLE_EQ(make('p', {15, 40, 30})->value(0.5), 15 + 20 + 7.5);
}

TEST(OrganFunction, CosineSeriesHasFreeEnds) {
  const auto f = make('f', {10, -10, 4});
  EXPECT_NEAR(f->value(0), 10 - 10 + 4, 1e-14);
  EXPECT_NEAR(f->value(1), 10 + 10 + 4, 1e-14);
  EXPECT_NEAR(f->value(0.5), 10 - 4, 1e-14);
}

TEST(OrganFunction, NaturalSplineIsSmoothAndStraightAtTheEnds) {
  const auto f = make('s', {0, 5, 0.25, 30, 0.6, -10, 1, 90});
  EXPECT_NEAR(f->value(0.25), 30, 1e-12);
  EXPECT_NEAR(f->value(0.6), -10, 1e-12);
  const double h = 1e-4;
  for (const double knot : {0.25, 0.6}) {
    EXPECT_NEAR(f->derivative(knot - 1e-9), f->derivative(knot + 1e-9), 1e-5);
    const double before = (f->derivative(knot) - f->derivative(knot - h)) / h;
    const double after = (f->derivative(knot + h) - f->derivative(knot)) / h;
    EXPECT_NEAR(before, after, 0.5) << "second derivative of some hundreds";
  }
  EXPECT_NEAR((f->derivative(h) - f->derivative(0)) / h, 0, 0.5);
  EXPECT_NEAR((f->derivative(1) - f->derivative(1 - h)) / h, 0, 0.5);
  // Three knots by hand: values 0 1 0 at 0 1/2 1 give the second derivative -12 in the middle.
  const auto hat = make('s', {0, 0, 0.5, 1, 1, 0});
  EXPECT_NEAR(hat->value(0.25), 0.5 + 12.0 / 6 * (0.5 - 0.125) * 0.25, 1e-12);
}

TEST(OrganFunction, DerivativesAreThoseOfTheValues) {
  for (const Example& example : examples) {
    const auto f = make(example.code, example.numbers, radians(1));
    for (const double l : {0.05, 0.28, 0.305, 0.5, 0.93}) {
      const double h = 1e-6;
      EXPECT_NEAR(f->derivative(l), (f->value(l + h) - f->value(l - h)) / (2 * h), 1e-6) << example.code << l;
    }
  }
}

TEST(OrganFunction, IsLinearInItsCoefficients) {
  for (const Example& example : examples) {
    const auto f = make(example.code, example.numbers, radians(1));
    std::vector<double> coefficients(static_cast<std::size_t>(f->coefficients()));
    for (std::size_t k = 0; k < coefficients.size(); ++k) coefficients[k] = 3.0 * static_cast<double>(k) - 4;
    const auto g = f->with_coefficients(coefficients);
    EXPECT_EQ(g->code(), f->code());
    std::vector<double> basis(coefficients.size());
    for (const double l : {0.0, 0.1, 0.305, 0.77, 1.0}) {
      f->basis(l, basis.data());
      double sum = 0;
      for (std::size_t k = 0; k < basis.size(); ++k) sum += coefficients[k] * basis[k];
      EXPECT_NEAR(g->value(l), sum, 1e-12) << example.code << l;
    }
    EXPECT_EQ(f->clone()->numbers(), example.numbers);
  }
}

TEST(OrganFunction, BlankOnesHaveTheOrderAskedFor) {
  EXPECT_EQ(blank_organ_function('p', 3, 1)->coefficients(), 4);
  EXPECT_EQ(blank_organ_function('f', 2, 1)->coefficients(), 3);
  EXPECT_EQ(blank_organ_function('n', 4, 1)->numbers(),
            (std::vector<double>{0, 0, 1.0 / 3, 0, 2.0 / 3, 0, 1, 0}));
  EXPECT_EQ(blank_organ_function('s', 5, 1)->coefficients(), 5);
  BPMS_EXPECT_ERROR(blank_organ_function('n', 1, 1), bad_input, "expected an order from 2");
  BPMS_EXPECT_ERROR(blank_organ_function('p', -1, 1), bad_input, "expected an order from 0");
}

TEST(OrganFunction, TextReadsBack) {
  EXPECT_EQ(organ_function_text(*make('p', {15, 40, 30})), "p 15 40 30");
  EXPECT_EQ(organ_function_text(*make('n', {0, 0.1, 1, 1.0 / 3})), "n 0 0.1 1 0.3333333333333333");
}

TEST(OrganFunction, ErrorsAreLocated) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BPMS_EXPECT_ERROR(make('q', {1}), bad_input,
                    "x.bpms:3:7: unknown function code 'q'; known: n (piecewise linear), p");
  BPMS_EXPECT_ERROR(make('N', {0, 0, 1, 1}), bad_input, "did you mean 'n'?");
  BPMS_EXPECT_ERROR(make('p', {}), bad_input, "function p has no numbers");
  BPMS_EXPECT_ERROR(make('n', {0, 1, 1}), bad_input, "x.bpms:3:7: function n has 3 numbers, expected pairs");
  BPMS_EXPECT_ERROR(make('n', {0, 1}), bad_input, "at least two");
  BPMS_EXPECT_ERROR(make('s', {0, 1, 0.5, 2, 0.5, 3, 1, 0}), bad_input,
                    "l = 0.5 of pair 3 does not rise above 0.5");
  BPMS_EXPECT_ERROR(make('n', {0.1, 1, 1, 2}), bad_input, "begins at l = 0.1, expected 0");
  BPMS_EXPECT_ERROR(make('n', {0, 1, 0.9, 2}), bad_input, "ends at l = 0.9, expected 1");
  BPMS_EXPECT_ERROR(make('p', {0, nan}), bad_input, "number 2 is nan, expected a finite number");
  BPMS_EXPECT_ERROR(make('p', {0, 1e7}), bad_input, "number 2 is 10000000");
  BPMS_EXPECT_ERROR(make('p', std::vector<double>(500, 1.0)), bad_input, "500 numbers, more than 400");
}

}  // namespace
}  // namespace bpms
