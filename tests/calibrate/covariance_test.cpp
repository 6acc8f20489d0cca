// Many calibrations of one synthetic scene: their scatter against the covariances that they report.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <cstdio>

#include "calibrate/adjustment/bundle_adjustment.h"
#include "calibrate/adjustment/normal_equations.h"
#include "calibrate/adjustment/synthetic.h"
#include "calibrate/adjustment/uncertainty.h"
#include "calibrate/calibrate.h"
#include "core/parallel.h"
#include "tests/calibrate/errors.h"

namespace bpms {
namespace {

// The errors' square in units of the delivered covariance is chi-squared with as many degrees of freedom as
// there are parameters (times an F correction of 1e-3 for the estimated sigma). The band is 3 standard errors
// of the mean.
TEST(Covariance, IsWhatTheErrorsAre) {
  const SyntheticCalibration scene = synthetic_calibration({.frames = 10, .seed = 3});
  constexpr std::size_t runs = 300;
  constexpr double sigma = 0.15;
  std::vector<double> nees(runs), chi2(runs), baseline(runs);
  std::vector<Eigen::VectorXd> normalised(runs);
  parallel_for(runs, [&](std::size_t run) {
    const Calibration c = calibrate(observe(scene, sigma, 100 + run), scene.target, {.uncertainty = false});
    const Eigen::VectorXd e = test::errors(c.rig.cameras, scene.truth.cameras);
    nees[run] = e.dot(c.rig.covariance->matrix.ldlt().solve(e));
    normalised[run] = e.cwiseQuotient(c.rig.covariance->matrix.diagonal().cwiseSqrt());
    chi2[run] = std::pow(c.residual_sigma_px / sigma, 2);
    baseline[run] = (c.pairs[0].baseline_m - scene.truth.cameras[1].t_cam_from_rig_m.norm()) /
                    c.pairs[0].baseline_sigma_m;
  });
  const double d = static_cast<double>(normalised[0].size()), k = runs;
  double nees_mean = 0, chi2_mean = 0, baseline_square = 0;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(normalised[0].size());
  for (std::size_t run = 0; run < runs; ++run) {
    nees_mean += nees[run] / k / d;
    chi2_mean += chi2[run] / k;
    baseline_square += baseline[run] * baseline[run] / k;
    mean += normalised[run] / k;
  }
  const double band = 3 * std::sqrt(2 / (k * d));
  const double dof = 2.0 * 10 * 2 * 54 - (2 * 8 + 6 + 2 + 6 * 10);
  std::printf("NEES/dof %.4f (band %.4f), chi2/dof %.4f, baseline %.3f\n", nees_mean, band, chi2_mean,
              baseline_square);
  EXPECT_NEAR(nees_mean, dof / (dof - 2), band);
  EXPECT_NEAR(chi2_mean, 1, 3 * std::sqrt(2 / (k * dof)));
  EXPECT_NEAR(baseline_square, 1, 3 * std::sqrt(2 / k));
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 4 / std::sqrt(k));
  // The test has teeth: a sigma 1.2 times too large would not pass.
  EXPECT_GT(std::abs(nees_mean / 1.44 - 1), band);
}

BundleProblem whole_problem(const SyntheticCalibration& scene, const Observations& observations) {
  BundleProblem out = scene.problem();
  for (std::size_t v = 0; v < observations.views.size(); ++v) {
    const BoardView& view = observations.views[v];
    for (const ImageCorner& c : view.corners)
      out.corners.push_back(
          {static_cast<int>(v), static_cast<int>(v) % out.frames, view.camera, 0, c.point, c.pixel});
  }
  return out;
}

// Normal errors have a closed form for both clustered variances, with S the information, S_f that of frame f:
//   jackknife  E[V] = (F-1)/F sum_f [(S - S_f)^-1 - S^-1] sigma^2   (b_-f - b is uncorrelated with b; Hausman
//   1978) sandwich   E[V] = F/(F-1) S^-1 [sum_f S_f - S_f S^-1 S_f] S^-1 sigma^2
class ClusteredVariance : public ::testing::TestWithParam<int> {};
TEST_P(ClusteredVariance, HasItsExpectationForIndependentErrors) {
  const int frames = GetParam();
  constexpr double sigma = 0.15;
  constexpr std::size_t runs = 24;
  const SyntheticCalibration scene = synthetic_calibration({.frames = frames, .seed = 7});
  const BundleProblem noise_free = whole_problem(scene, observe(scene, 0, 1));
  const Eigen::MatrixXd s = normal_equations(noise_free, scene.truth).information, c = s.inverse();
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(s.rows(), s.cols());
  const double f = frames;
  for (int frame = 0; frame < frames; ++frame) {
    BundleProblem one = noise_free;
    std::erase_if(one.corners, [&](const CornerObservation& corner) { return corner.frame != frame; });
    const Eigen::MatrixXd s_f = normal_equations(one, scene.truth).information;
    if (frames < 20)
      expected += (f - 1) / f * ((s - s_f).inverse() - c);
    else
      expected += f / (f - 1) * c * (s_f - s_f * c * s_f) * c;
  }
  std::vector<Eigen::VectorXd> variance(runs);
  parallel_for(runs, [&](std::size_t run) {
    const BundleProblem problem = whole_problem(scene, observe(scene, sigma, 500 + run));
    BundleState state = scene.truth;
    ASSERT_TRUE(adjust(problem, {}, state).converged);
    const NormalEquations equations = normal_equations(problem, state);
    variance[run] =
        clustered_by_frame(problem, state, equations, cofactors(equations), {{0, 1}}).sigma.cwiseAbs2();
  });
  // Mean over runs and parameters of variance over its expectation; the standard error from the runs
  // themselves.
  const Eigen::Index n = variance[0].size();
  const Eigen::VectorXd predicted = sigma * sigma * expected.diagonal().head(n);
  std::vector<double> ratio;
  double mean = 0, square = 0;
  for (const Eigen::VectorXd& v : variance) ratio.push_back(v.cwiseQuotient(predicted).mean());
  for (const double r : ratio) mean += r / runs;
  for (const double r : ratio) square += (r - mean) * (r - mean) / (runs * (runs - 1.0));
  std::printf("clustered variance over its expectation, %d frames: %.3f +- %.3f\n", frames, mean,
              std::sqrt(square));
  EXPECT_NEAR(mean, 1, 3 * std::sqrt(square));
  EXPECT_LT(3 * std::sqrt(square), 0.4);  // sharp enough to tell a missing factor
}
INSTANTIATE_TEST_SUITE_P(JackknifeAndSandwich, ClusteredVariance, ::testing::Values(13, 24));

}  // namespace
}  // namespace bpms
