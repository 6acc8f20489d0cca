#include "fit/function_basis.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>

namespace bpms {

const double gauss_node[gauss_points] = {0.033765242898423986, 0.16939530676686774, 0.38069040695840155,
                                         0.61930959304159845,  0.83060469323313226, 0.96623475710157601};
const double gauss_weight[gauss_points] = {0.085662246189585173, 0.18038078652406930, 0.23395696728634552,
                                           0.23395696728634552,  0.18038078652406930, 0.085662246189585173};

namespace {

// Panels between breaks, so fine that the six-point rule integrates products of two basis functions.
std::vector<double> panel_ends(const std::vector<double>& breaks) {
  constexpr int uniform = 16;
  std::vector<double> ends = breaks;
  for (int i = 0; i <= uniform; ++i) ends.push_back(static_cast<double>(i) / uniform);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end(), [](double a, double b) { return b - a < 1e-12; }),
             ends.end());
  return ends;
}

Eigen::MatrixXd gram_matrix(const OrganFunction& family) {
  const int n = family.coefficients();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd basis(n);
  const std::vector<double> ends = panel_ends(family.breaks());
  for (std::size_t p = 0; p + 1 < ends.size(); ++p) {
    for (int g = 0; g < gauss_points; ++g) {
      const double width = ends[p + 1] - ends[p];
      family.basis(ends[p] + width * gauss_node[g], basis.data());
      gram += width * gauss_weight[g] * basis * basis.transpose();
    }
  }
  return gram;
}

}  // namespace

FunctionBasis::FunctionBasis(FunctionChoice choice, bool with_constant) : choice_(choice) {
  // A constant is the same in every kind, and the power series has it as its order 0.
  family_ = choice.order == 0 ? blank_organ_function('p', 0, 1.0)
                              : blank_organ_function(choice.code, choice.order, 1.0);
  const int n = family_->coefficients();
  if (n > most_coefficients) bad_input({}, "a function of {} coefficients is more than a fit can use", n);
  const Eigen::MatrixXd gram = gram_matrix(*family_);
  // The constant's coefficients: power and cosine series have it first, interpolating kinds in equal values.
  Eigen::VectorXd constant = Eigen::VectorXd::Ones(n);
  if (family_->code() == 'p' || family_->code() == 'f') constant.tail(n - 1).setZero();
  // Gram-Schmidt, twice for accuracy; the one vector that depends on those before it drops out.
  std::vector<Eigen::VectorXd> columns;
  constexpr double dependent = 1e-8;
  for (int k = -1; k < n; ++k) {
    Eigen::VectorXd v = k < 0 ? constant : Eigen::VectorXd(Eigen::VectorXd::Unit(n, k));
    const double before = std::sqrt(v.dot(gram * v));
    for (int pass = 0; pass < 2; ++pass)
      for (const Eigen::VectorXd& u : columns) v -= u.dot(gram * v) * u;
    const double after = std::sqrt(std::max(0.0, v.dot(gram * v)));
    if (after > dependent * before && static_cast<int>(columns.size()) < n) columns.push_back(v / after);
  }
  const std::size_t first = with_constant ? 0 : 1;
  transform_.resize(n, static_cast<Eigen::Index>(columns.size() - first));
  for (std::size_t k = first; k < columns.size(); ++k)
    transform_.col(static_cast<Eigen::Index>(k - first)) = columns[k];
}

void FunctionBasis::values(double l, double* out) const {
  if (size() == 0) return;
  std::array<double, most_coefficients> raw;
  family_->basis(l, raw.data());
  for (Eigen::Index k = 0; k < transform_.cols(); ++k) {
    double sum = 0;
    for (Eigen::Index i = 0; i < transform_.rows(); ++i)
      sum += transform_(i, k) * raw[static_cast<std::size_t>(i)];
    out[k] = sum;
  }
}

void FunctionBasis::raw(double l, double* out) const {
  family_->basis(l, out);
}

std::vector<double> FunctionBasis::breaks() const {
  return family_ ? family_->breaks() : std::vector<double>{};
}

Eigen::VectorXd FunctionBasis::project(const std::vector<double>& l, const std::vector<double>& value,
                                       const std::vector<double>& weight) const {
  if (size() == 0) return {};
  const auto rows = static_cast<Eigen::Index>(l.size());
  // A whiff of ridge: fewer samples than coefficients must give a smooth start, not a wild one.
  constexpr double ridge = 1e-3;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows + size(), size());
  Eigen::VectorXd b = Eigen::VectorXd::Zero(rows + size());
  Eigen::VectorXd phi(size());
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto s = static_cast<std::size_t>(i);
    values(l[s], phi.data());
    a.row(i) = std::sqrt(weight[s]) * phi.transpose();
    b[i] = std::sqrt(weight[s]) * value[s];
  }
  for (Eigen::Index k = 1; k < size(); ++k) a(rows + k, k) = ridge * static_cast<double>(k);
  return a.colPivHouseholderQr().solve(b);
}

std::unique_ptr<OrganFunction> FunctionBasis::function(const Eigen::VectorXd& coefficients,
                                                       double scale) const {
  const auto blank = blank_organ_function(family_->code(), choice_.order, scale);
  return blank->with_coefficients({coefficients.data(), coefficients.data() + coefficients.size()});
}

}  // namespace bpms
