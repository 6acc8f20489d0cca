// Are the covariances true? Normalised estimation error squared e' C^-1 e ~ chi-square with 3 degrees of
// freedom.
#include <gtest/gtest.h>

#include "reconstruct/points/rig_errors.h"
#include "tests/reconstruct/synthetic.h"

namespace bpms {
namespace {

constexpr int trials = 4000;
// Three standard errors of the mean of `trials` chi-squares with 3 degrees of freedom.
const double band = 3 * std::sqrt(2.0 * 3.0 / trials);

struct Summary {
  double nees = 0;              // mean
  double nees_without_rig = 0;  // mean with the digitising covariance alone
  double chi2_per_dof = 0;      // mean
  std::vector<double> p;        // of the gate
  Eigen::Vector3d sum_squares = Eigen::Vector3d::Zero();
};

// `claim`: the sigma that the reconstruction is told, over the true one. `place`: nullptr, somewhere.
Summary run(const Rig& rig, double sigma_px, double claim, std::uint64_t seed,
            const Eigen::Vector3d* place = nullptr) {
  Summary out;
  Philox random(seed);
  ReconstructOptions options;
  options.gate_p = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const Eigen::Vector3d x = place != nullptr ? *place : test::somewhere(random);
    const Rig truth = rig.covariance ? test::draw(rig, random) : rig;
    auto sightings = test::sight(truth, x, sigma_px, &random);
    for (Sighting& s : sightings) s.sigma_px *= claim;
    const Vectors vectors = reconstruct(test::image_points(rig, 1, sightings), rig, options);
    const auto& point = vectors.points.front();
    if (!point.accepted()) throw std::runtime_error(point.reason);
    const auto& estimate = *point.estimate;
    const Eigen::Vector3d error = estimate.x_m - x;
    out.nees += error.dot(estimate.covariance_m2().ldlt().solve(error)) / trials;
    out.nees_without_rig += error.dot(estimate.digitising_covariance_m2.ldlt().solve(error)) / trials;
    out.chi2_per_dof += estimate.chi2 / estimate.dof / trials;
    out.p.push_back(estimate.p);
    out.sum_squares += error.cwiseAbs2();
  }
  return out;
}

TEST(Honesty, DigitisingCovariance) {
  std::uint64_t seed = 10;
  for (const Rig& rig : {test::parallel_rig(), test::convergent_rig(2), test::convergent_rig(3)}) {
    const Summary result = run(rig, 0.5, 1.0, ++seed);
    EXPECT_NEAR(result.nees, 3, band);
    EXPECT_LT(test::kolmogorov(result.p), test::kolmogorov_limit);
    const double dof = 2.0 * static_cast<double>(rig.cameras.size()) - 3;
    EXPECT_NEAR(result.chi2_per_dof, 1, 3 * std::sqrt(2 / (dof * trials)));
  }
}

TEST(Honesty, AWrongSigmaIsFoundOut) {
  const Summary result = run(test::convergent_rig(3), 0.5, 1.2, 20);
  EXPECT_LT(result.nees, 3 - band);
  EXPECT_GT(test::kolmogorov(result.p), test::kolmogorov_limit);
  EXPECT_NEAR(result.nees, 3 / 1.44, band);
}

TEST(Honesty, RigErrorsAreCarriedOver) {
  std::uint64_t seed = 30;
  for (Rig rig : {test::parallel_rig(), test::convergent_rig(2), test::convergent_rig(3)}) {
    test::give_covariance(rig, 1.0, ++seed);
    const Summary result = run(rig, 0.2, 1.0, ++seed);
    EXPECT_NEAR(result.nees, 3, band);
    EXPECT_GT(result.nees_without_rig, 2 * 3) << "the rig's part must matter, or the test says nothing";
    EXPECT_LT(test::kolmogorov(result.p), test::kolmogorov_limit);
    EXPECT_NEAR(result.chi2_per_dof, 1, 3 * std::sqrt(2.0 / trials));
  }
}

TEST(Honesty, DepthSigmaOfAParallelRigInClosedForm) {
  // sigma_Z = sqrt2 Z^2 sigma / (f B); sigma_X^2 = (Z sigma / (sqrt2 f))^2 + (X/Z)^2 sigma_Z^2, X from the
  // middle of the baseline; equal sigmas.
  constexpr double sigma = 0.5;
  const Rig rig = test::parallel_rig();
  for (const Eigen::Vector3d& x :
       {Eigen::Vector3d(0, 0, 1.5), Eigen::Vector3d(0.1, -0.1, 1.2), Eigen::Vector3d(-0.1, 0.05, 2.5)}) {
    auto sightings = test::sight(rig, x, sigma, nullptr);
    for (Sighting& s : sightings) s.sigma_px = sigma;
    const auto points = reconstruct(test::image_points(rig, 1, sightings), rig).points;
    const Eigen::Matrix3d c = points.front().estimate->covariance_m2();
    const double sigma_z =
        std::sqrt(2.0) * x.z() * x.z() * sigma / (test::parallel_focal_px * test::parallel_baseline_m);
    const double across = x.z() * sigma / (std::sqrt(2.0) * test::parallel_focal_px);
    EXPECT_NEAR(std::sqrt(c(2, 2)) / sigma_z, 1, 1e-9);
    EXPECT_NEAR(std::sqrt(c(0, 0)) / std::hypot(across, x.x() / x.z() * sigma_z), 1, 1e-9);
    EXPECT_NEAR(std::sqrt(c(1, 1)) / std::hypot(across, x.y() / x.z() * sigma_z), 1, 1e-9);
  }
  // And the errors are that large: the relative standard error of a standard deviation is 1/sqrt(2 trials).
  // The second camera of the synthetic sightings has 1.5 sigma.
  const Eigen::Vector3d x(0, 0, 1.5);
  const Summary result = run(rig, sigma, 1.0, 40, &x);
  const double sigma_z =
      std::hypot(1, 1.5) * x.z() * x.z() * sigma / (test::parallel_focal_px * test::parallel_baseline_m);
  EXPECT_NEAR(std::sqrt(result.sum_squares.z() / trials) / sigma_z, 1, 3 / std::sqrt(2.0 * trials));
}

TEST(Honesty, RigDerivativesAgreeWithDifferences) {
  Rig rig = test::convergent_rig(3);
  test::give_covariance(rig, 1.0, 50);
  Philox random(51);
  const Eigen::Vector3d x = test::somewhere(random);
  // Without residuals the estimator's derivative is exact, not only to first order in the residuals.
  const auto points = test::image_points(rig, 1, test::sight(rig, x, 0.5, nullptr));
  const Eigen::MatrixXd by_rig = reconstruct(points, rig).points.front().estimate->by_rig;
  const auto moved = [&](std::size_t column, double step) {
    Rig out = rig;
    std::size_t at = 0;
    for (Camera& c : out.cameras) {
      for (double& p : c.parameters) p += at++ == column ? step : 0;
      Eigen::Vector3d w = Eigen::Vector3d::Zero();
      for (int k = 0; k < 3; ++k) w[k] = at++ == column ? step : 0;
      if (w.norm() > 0)
        c.r_cam_from_rig = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix() * c.r_cam_from_rig;
      for (int k = 0; k < 3; ++k) c.t_cam_from_rig_m[k] += at++ == column ? step : 0;
    }
    return Eigen::Vector3d(reconstruct(points, out, {0, true, {}}).points.front().estimate->x_m);
  };
  for (std::size_t k = 0; k < rig.covariance->order.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const double step = std::sqrt(rig.covariance->matrix(column, column));
    const Eigen::Vector3d difference = (moved(k, step) - moved(k, -step)) / (2 * step);
    EXPECT_LT((difference - by_rig.col(column)).norm(), 1e-4 * by_rig.col(column).norm() + 1e-9)
        << rig.covariance->order[k];
  }
}

TEST(Honesty, RigErrorsOnlyOfTheParametersNamed) {
  Rig rig = test::parallel_rig();
  // An error of the baseline alone scales depth: sigma_Z = Z sigma_B / B.
  constexpr double sigma_b = 1e-3;
  rig.covariance = Rig::Covariance{{"right.tx"}, Eigen::MatrixXd::Constant(1, 1, sigma_b * sigma_b), "iid"};
  const Eigen::Vector3d x(0, 0, 1.5);
  const auto points = reconstruct(test::image_points(rig, 1, test::sight(rig, x, 0.5, nullptr)), rig).points;
  EXPECT_NEAR(std::sqrt(points.front().estimate->rig_covariance_m2(2, 2)),
              x.z() * sigma_b / test::parallel_baseline_m, 1e-9);
  rig.covariance->order = {"right.tz_m"};
  EXPECT_THROW(RigErrors{rig}, Error);
}

}  // namespace
}  // namespace bpms
