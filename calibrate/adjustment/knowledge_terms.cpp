#include "calibrate/adjustment/knowledge_terms.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace bpms {
namespace {

using ConstVector3 = Eigen::Map<const Eigen::Vector3d>;

// Weights times the shifts of some points.
class LinearTerm final : public ceres::CostFunction {
 public:
  explicit LinearTerm(std::vector<Eigen::Matrix<double, Eigen::Dynamic, 3>> weights)
      : weights_(std::move(weights)) {
    set_num_residuals(static_cast<int>(weights_.front().rows()));
    mutable_parameter_block_sizes()->assign(weights_.size(), 3);
  }
  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(num_residuals());
    for (std::size_t k = 0; k < weights_.size(); ++k) {
      sum += weights_[k] * ConstVector3(p[k]);
      if (jacobians != nullptr && jacobians[k] != nullptr)
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>>(jacobians[k], num_residuals(),
                                                                              3) = weights_[k];
    }
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = sum;
    return true;
  }

 private:
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, 3>> weights_;
};

class ScaleBarTerm final : public ceres::CostFunction {
 public:
  ScaleBarTerm(const ScaleBar& bar, const Eigen::Vector3d& a_m, const Eigen::Vector3d& b_m, double weight)
      : between_(b_m - a_m), length_m_(bar.length_m), weight_(weight) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->assign(2, 3);
  }
  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    const Eigen::Vector3d d = between_ + ConstVector3(p[1]) - ConstVector3(p[0]);
    const double length = d.norm();
    if (!(length > 0)) return false;
    residuals[0] = weight_ * (length - length_m_);
    for (int k = 0; jacobians != nullptr && k < 2; ++k) {
      if (jacobians[k] != nullptr)
        Eigen::Map<Eigen::Vector3d>{jacobians[k]} = (k == 0 ? -weight_ : weight_) / length * d;
    }
    return true;
  }

 private:
  Eigen::Vector3d between_;
  double length_m_, weight_;
};

class LensPriorTerm final : public ceres::CostFunction {
 public:
  LensPriorTerm(std::vector<LensPrior> priors, std::size_t count, double sigma_px)
      : priors_(std::move(priors)), count_(static_cast<Eigen::Index>(count)), sigma_px_(sigma_px) {
    set_num_residuals(static_cast<int>(priors_.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(count));
  }
  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    const bool jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    if (jacobian) std::fill_n(jacobians[0], count_ * num_residuals(), 0.0);
    for (std::size_t row = 0; row < priors_.size(); ++row) {
      const LensPrior& prior = priors_[row];
      const double weight = sigma_px_ / prior.sigma;
      residuals[row] = -weight * prior.value;
      for (const auto& [i, factor] : prior.coefficients) {
        residuals[row] += weight * factor * p[0][i];
        if (jacobian) jacobians[0][static_cast<Eigen::Index>(row) * count_ + i] += weight * factor;
      }
    }
    return true;
  }

 private:
  std::vector<LensPrior> priors_;
  Eigen::Index count_;
  double sigma_px_;
};

}  // namespace

std::unique_ptr<ceres::CostFunction> lens_prior_term(std::vector<LensPrior> priors, std::size_t parameters,
                                                     double sigma_px) {
  return std::make_unique<LensPriorTerm>(std::move(priors), parameters, sigma_px);
}

std::unique_ptr<ceres::CostFunction> surveyed_point_term(const Eigen::Matrix3d& covariance_m2,
                                                         double sigma_px) {
  const Eigen::LLT<Eigen::Matrix3d> llt(covariance_m2);
  if (llt.info() != Eigen::Success)
    throw Error(ErrorKind::bad_input, "the covariance of a surveyed point is not positive definite");
  const Eigen::Matrix3d inverse = llt.matrixL().solve(Eigen::Matrix3d::Identity());
  return std::make_unique<LinearTerm>(
      std::vector<Eigen::Matrix<double, Eigen::Dynamic, 3>>{sigma_px * inverse});
}

std::unique_ptr<ceres::CostFunction> scale_bar_term(const ScaleBar& bar, const Eigen::Vector3d& a_m,
                                                    const Eigen::Vector3d& b_m, double sigma_px) {
  return std::make_unique<ScaleBarTerm>(bar, a_m, b_m, sigma_px / bar.sigma_m);
}

std::unique_ptr<ceres::CostFunction> inner_constraints(const std::vector<Eigen::Vector3d>& points_m,
                                                       bool with_size, double sigma_px) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  const double n = static_cast<double>(points_m.size());
  for (const Eigen::Vector3d& x : points_m) centre += x / n;
  double spread = 0;
  for (const Eigen::Vector3d& x : points_m) spread += (x - centre).squaredNorm() / n;
  spread = std::sqrt(spread);
  if (!(spread > 0)) throw Error(ErrorKind::bad_input, "the points of a free target lie in one place");
  // Tight beside what pixels tell, far above rounding: a part in 1e5 of the target's size weighs as a pixel.
  const double weight = 1e5 * sigma_px / (spread * n);
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, 3>> weights;
  for (const Eigen::Vector3d& x : points_m) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> w(with_size ? 7 : 6, 3);
    const Eigen::Vector3d from = (x - centre) / spread;
    w.topRows<3>().setIdentity();
    w.middleRows<3>(3) = cross_matrix(from);
    if (with_size) w.row(6) = from.transpose();
    weights.emplace_back(weight * w);
  }
  return std::make_unique<LinearTerm>(std::move(weights));
}

}  // namespace bpms
