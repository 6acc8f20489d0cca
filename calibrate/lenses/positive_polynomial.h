// Whether a polynomial stays above zero over an interval: what decides if a radial distortion rises strictly.
#pragma once
#include <array>
#include <cstddef>

namespace bpms {

constexpr std::size_t polynomial_degree = 6;
using Polynomial = std::array<double, polynomial_degree + 1>;  // coefficients of s^0 ... s^6

Polynomial product(const Polynomial& a, const Polynomial& b);  // terms beyond the degree are dropped
Polynomial scaled_derivative(Polynomial a);                    // s d/ds
// On all of [0, s]. A double root, where it only touches zero, counts as no.
bool positive_up_to(Polynomial a, double s);

}  // namespace bpms
