// The functions of one kind and order as a vector space, with a basis that is orthonormal in L2 on [0, 1]:
//   value(l) = sum_k beta_k phi_k(l),  integral of phi_j phi_k = delta_jk,  phi_0 = 1.
// The normal equations of a fit are then well conditioned whatever the kind, and "the mean of the function is
// zero" is simply beta_0 = 0. Coefficients in the text's own basis (p, f, n, s) are transform() * beta.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "plant/organ_function.h"

namespace bpms {

// "p:3": a kind and its order, as blank_organ_function counts them. Order 0 of any kind: the constant.
struct FunctionChoice {
  char code = 'p';
  int order = 3;
  std::string str() const { return std::string(1, code) + ":" + std::to_string(order); }
  bool operator==(const FunctionChoice&) const = default;
};

inline constexpr int most_coefficients = 15;  // of one function: more than digitised points can carry

class FunctionBasis {
 public:
  FunctionBasis() = default;  // the zero function: no coefficients
  // Without the constant, the basis spans the functions whose mean over [0, 1] is zero.
  FunctionBasis(FunctionChoice choice, bool with_constant);

  int size() const { return static_cast<int>(transform_.cols()); }
  FunctionChoice choice() const { return choice_; }
  void values(double l, double* out) const;  // phi_k(l)
  void raw(double l, double* out) const;     // the kind's own basis
  const Eigen::MatrixXd& transform() const { return transform_; }
  std::vector<double> breaks() const;
  // The beta of the function nearest in L2 to samples at l (weights > 0).
  Eigen::VectorXd project(const std::vector<double>& l, const std::vector<double>& value,
                          const std::vector<double>& weight) const;
  // The organ function with these coefficients (in the text's basis), times `scale`.
  std::unique_ptr<OrganFunction> function(const Eigen::VectorXd& coefficients, double scale) const;

 private:
  FunctionChoice choice_;
  std::shared_ptr<const OrganFunction> family_;
  Eigen::MatrixXd transform_;  // coefficients of the kind x size()
};

// Nodes and weights of the Gauss-Legendre rule with six points on [0, 1].
inline constexpr int gauss_points = 6;
extern const double gauss_node[gauss_points];
extern const double gauss_weight[gauss_points];

}  // namespace bpms
