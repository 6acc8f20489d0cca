// Functions of normalised length l in [0, 1] that shape an organ (inclination, azimuth, twist, curvature,
// width). Codes in the plant text: n piecewise linear, p power series, f cosine series, s natural cubic
// spline. To add a kind: one file functions/organ_function_X.cpp with a class, and one line in the table of
// functions/organ_function.cpp.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"

namespace bpms {

class OrganFunction {
 public:
  virtual ~OrganFunction() = default;
  virtual char code() const = 0;
  virtual double value(double l) const = 0;
  virtual double derivative(double l) const = 0;
  // Numbers as they stand in the text behind the code (not scaled; angles there are in degrees).
  virtual const std::vector<double>& numbers() const = 0;
  virtual std::unique_ptr<OrganFunction> clone() const = 0;
  // Places in (0, 1) where a derivative may jump (knots): where a mesh or a quadrature should put a node.
  virtual std::vector<double> breaks() const { return {}; }
  // value = sum_k coefficient_k * basis_k(l): all kinds are linear in their coefficients (values at the knots
  // for n and s). Coefficients are in the unit of the text (degrees for angles); the basis holds the scale.
  virtual int coefficients() const = 0;
  virtual void basis(double l, double* out) const = 0;
  virtual std::unique_ptr<OrganFunction> with_coefficients(const std::vector<double>& values) const = 0;
};

// Makes a function from its code and numbers; bad_input at `where` for an unknown code, a wrong count, knots
// that do not rise from 0 to 1. value() and derivative() are in the numbers' own unit times `scale` (pi/180
// for angles).
std::unique_ptr<OrganFunction> make_organ_function(char code, std::vector<double> numbers, double scale,
                                                   const SourceLocation& where);
// A function of this kind and order with all coefficients zero: p:3 has 4 coefficients, f:2 has 3, n:4 and
// s:5 have as many knots, spread evenly.
std::unique_ptr<OrganFunction> blank_organ_function(char code, int order, double scale);
std::string organ_function_text(const OrganFunction& function);  // "p 15 40 30"

}  // namespace bpms
