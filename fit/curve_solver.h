// Least squares of a leaf model through measured points, the points' places along the curves being unknown
// too. Minimised: sum over points of min over l of |W (x - X(l))|^2 with W'W the inverse of the point's
// covariance: the orthogonal distance in the metric of its errors. l is eliminated point by point (variable
// projection, Kaufman's form: derivatives are projected off the curve's tangent), so the unknowns are the
// leaf's alone. The first and the last point of a midrib are the leaf's base (l = 0) and tip (l = 1).
#pragma once
#include <Eigen/Core>
#include <vector>

#include "fit/leaf_model.h"

namespace bpms {

struct LeafObservation {
  LeafCurve curve = LeafCurve::midrib;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Matrix3d whitening = Eigen::Matrix3d::Identity();  // a zero row: that combination was not measured
  int dimensions = 3;                                       // rows of the whitening that are not zero
  bool place_free = true;
  double l = 0;       // place along the curve: where the search starts, or fixed
  double weight = 1;  // of the squared residual; 0: left out
};

struct CurveSolution {
  Eigen::VectorXd parameters;
  Eigen::MatrixXd jacobian;       // whitened, off the tangents, by all parameters
  Eigen::MatrixXd covariance;     // (J'J)^-1 of the free parameters, not scaled
  std::vector<double> l;          // place of each observation
  std::vector<double> distance2;  // |W (x - X(l))|^2, also of those left out
  double chi2 = 0;                // weighted sum
  int residuals = 0;              // numbers that count: dimensions less places, of the observations used
  bool converged = false;
  bool full_rank = false;  // false: the covariance is a pseudo-inverse
  int degrees_of_freedom() const { return residuals - static_cast<int>(covariance.rows()); }
};

// The first `held` parameters stay as they are in `start`.
CurveSolution solve_curves(LeafModel& model, const std::vector<LeafObservation>& observations,
                           const Eigen::VectorXd& start, int held = 0);

}  // namespace bpms
