// E1(x) = integral from x to infinity of exp(-t) / t dt, for x > 0, to double precision: the power series up
// to 1, the continued fraction beyond (Abramowitz & Stegun 1964, 5.1.11 and 5.1.22).
#pragma once

namespace bpms {

double exponential_integral(double x);

}  // namespace bpms
