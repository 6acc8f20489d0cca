#include "calibrate/adjustment/lens_prior_term.h"

#include <algorithm>
#include <utility>

namespace bpms {
namespace {

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

std::unique_ptr<ceres::CostFunction> lens_prior_term(std::vector<LensPrior> priors, std::size_t count,
                                                     double sigma_px) {
  return std::make_unique<LensPriorTerm>(std::move(priors), count, sigma_px);
}

}  // namespace bpms
