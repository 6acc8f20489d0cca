// Stated uncertainties are true: chi2, coefficients' errors against their covariances, coverage of the bands.
// Bounds are multiples of the standard error of the statistic over the number of leaves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "core/parallel.h"
#include "tests/fit/leaf.h"

namespace bpms {
namespace {

using test::arching_leaf;
using test::exactly;

constexpr int leaves = 300;

struct Statistics {
  double chi2 = 0, dof = 0;
  std::map<std::string, double> nees, coefficients;  // sums over leaves
  std::map<std::string, int> inside, asked;  // of the bands at l = 0.1 .. 0.9 (one a leaf), and of the length
};

Statistics run(const SyntheticNoise& noise) {
  std::vector<OrganFit> fits(leaves);
  SyntheticLeaf leaf = arching_leaf();
  leaf.edge_points = 10;
  parallel_for(leaves, [&](std::size_t k) {
    Philox random(11, k);
    fits[k] =
        fit_organ(measure(leaf, noise, random), exactly("inclination=p:2,azimuth=p:1,twist=p:1,width=p:2"));
  });
  Statistics out;
  const std::map<std::string, std::pair<const OrganFunction*, double>> truth{
      {"inclination", {leaf.organ.f_inclination.get(), 1}},
      {"azimuth", {leaf.organ.f_azimuth.get(), 1}},
      {"twist", {leaf.organ.f_twist.get(), 1}},
      {"width", {leaf.organ.f_width.get(), leaf.organ.width_m}}};
  for (int k = 0; k < leaves; ++k) {
    const OrganFit& fit = fits[static_cast<std::size_t>(k)];
    EXPECT_TRUE(fit.ok()) << fit.failure;
    EXPECT_TRUE(fit.outliers.empty());
    if (!fit.ok()) continue;
    out.chi2 += fit.chi2;
    out.dof += fit.degrees_of_freedom;
    const auto count = [&](const std::string& name, double error, double sigma) {
      ++out.asked[name];
      if (std::abs(error) < 1.959964 * sigma) ++out.inside[name];
    };
    count("length", fit.length_m - leaf.organ.length_m, fit.length_sigma_m);
    count("direction", fit.direction - leaf.direction, fit.direction_sigma);
    const double l = 0.1 * (1 + k % 9) + 0.03;  // not in the middle, where this azimuth is zero by its gauge
    for (const auto& [name, function] : truth) {
      const FittedFunction& fitted = fit.functions.at(name);
      count(name, fitted.value(l) - function.second * function.first->value(l), fitted.sigma(l));
      Eigen::VectorXd error = fitted.coefficients;
      for (Eigen::Index i = 0; i < error.size(); ++i)
        error[i] -= function.first->numbers()[static_cast<std::size_t>(i)] *
                    (name == "width" ? leaf.organ.width_m : radians(1));
      // The azimuth's coefficients are bound by their zero mean: one less is free.
      const Eigen::Index free = name == "azimuth" ? error.size() - 1 : error.size();
      out.nees[name] += error.tail(free).dot(
          fitted.covariance.bottomRightCorner(free, free).ldlt().solve(error.tail(free)));
      out.coefficients[name] += static_cast<double>(free);
    }
  }
  return out;
}

// |x - mean| in standard deviations of a chi2 with n degrees of freedom.
double chi2_distance(double chi2, double n) {
  return std::abs(chi2 - n) / std::sqrt(2 * n);
}

TEST(Honesty, ChiSquareCoefficientsAndBands) {
  const Statistics s = run({.sigma_m = 3e-4});
  constexpr double limit = 3.5;  // standard errors; eleven statistics at one part in two thousand
  EXPECT_LT(chi2_distance(s.chi2, s.dof), limit) << s.chi2 / s.dof;
  // Covariances are multiplied by chi2 per degree of freedom when it is above one: they are a little wide, by
  // E max(1, chi2/dof) = 1 + 0.4 sqrt(2/dof); the bounds allow for it on that side only.
  const double wide = 1 + 0.4 * std::sqrt(2 * leaves / s.dof);
  for (const auto& [name, nees] : s.nees) {
    const double n = s.coefficients.at(name);
    EXPECT_GT(nees * wide, n - limit * std::sqrt(2 * n)) << name;
    EXPECT_LT(nees, n + limit * std::sqrt(2 * n)) << name;
  }
  for (const auto& [name, asked] : s.asked) {
    const double expected = 0.95 * asked, sd = std::sqrt(asked * 0.95 * 0.05);
    EXPECT_GT(s.inside.at(name), expected - limit * sd) << name;
    EXPECT_LT(s.inside.at(name), 0.96 * asked + limit * sd)
        << name;  // the bands are wide by some percent, as above
  }
}

TEST(Honesty, ErrorsStatedTooSmallOrTooLargeAreSeen) {
  const Statistics small = run({.sigma_m = 3e-4, .stated_ratio = 0.8});
  EXPECT_GT(chi2_distance(small.chi2, small.dof), 10);
  const Statistics large = run({.sigma_m = 3e-4, .stated_ratio = 1.25});
  EXPECT_GT(chi2_distance(large.chi2, large.dof), 10);
}

TEST(Honesty, WithoutStatedErrorsTheSigmaIsEstimated) {
  double sum = 0;
  constexpr double sigma = 2e-4;
  for (std::uint64_t k = 0; k < 50; ++k) {
    SyntheticLeaf leaf = arching_leaf();
    leaf.midrib_points = 25;
    Philox random(12, k);
    MeasuredOrgan organ = measure(leaf, {.sigma_m = sigma, .depth_ratio = 1}, random);
    for (VectorPoint& p : organ.midrib) p.covariance_m2.setZero();
    const OrganFit fit = fit_organ(organ, exactly("inclination=p:2,azimuth=p:1"));
    ASSERT_TRUE(fit.ok());
    EXPECT_FALSE(fit.chi2_per_dof.has_value());
    sum += fit.sigma_m / 50;
  }
  // Places come from arc length, whose own noise adds to that of the points (up to a factor of about 1.5).
  EXPECT_GT(sum, 0.8 * sigma);
  EXPECT_LT(sum, 1.8 * sigma);
}

TEST(Outliers, AreFoundAndNothingElseIs) {
  SyntheticLeaf leaf = arching_leaf();
  int found = 0, false_alarms = 0;
  for (std::uint64_t k = 0; k < 50; ++k) {
    Philox random(13, k);
    MeasuredOrgan organ = measure(leaf, {.sigma_m = 3e-4}, random);
    organ.midrib[6].x_m += Eigen::Vector3d(0.004, -0.006, 0.012);
    const OrganFit fit = fit_organ(organ, exactly("inclination=p:2,azimuth=p:1"));
    for (const int number : fit.outliers) (number == organ.midrib[6].point ? found : false_alarms) += 1;
  }
  EXPECT_EQ(found, 50);
  EXPECT_EQ(false_alarms, 0);
}

TEST(Choice, EvidencePicksTheTrueOrderMostOfTheTime) {
  SyntheticLeaf leaf = arching_leaf();
  leaf.organ.f_inclination = test::angles('p', {10, 160, -90});
  leaf.midrib_points = 20;
  constexpr int tries = 40;
  std::vector<int> right(tries), coefficients(tries);
  parallel_for(tries, [&](std::size_t k) {
    Philox random(14, k);
    const OrganFit fit = fit_organ(measure(leaf, {.sigma_m = 3e-4}, random), exactly("auto"));
    right[k] = fit.functions.at("inclination").choice == FunctionChoice{'p', 2};
    coefficients[k] = static_cast<int>(fit.functions.at("inclination").coefficients.size());
  });
  EXPECT_GT(std::count(right.begin(), right.end(), 1), tries / 2);
  EXPECT_LE(std::count_if(coefficients.begin(), coefficients.end(), [](int n) { return n < 3; }), 0);
}

}  // namespace
}  // namespace bpms
