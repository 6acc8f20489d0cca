// The front door of fit: measured polylines of organs -> the functions of their form, with covariances -> a
// plant. A leaf's inclination and azimuth are those whose integrated midrib passes the points, not angles of
// differences; edges add twist and width (ruled surface). Conventions: plant/leaf_frame.h; the estimator:
// docs/fitting.md.
#pragma once
#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/function_choice.h"
#include "fit/measured_organ.h"
#include "plant/plant.h"

namespace bpms {

struct FitOptions {
  FunctionRequest functions;
  bool anchor_base = false;  // the midrib starts exactly at the first point; else the base is free
  std::optional<double>
      direction;  // known direction of the leaf about the vertical, radians from x towards y
};

struct FittedFunction {
  FunctionChoice choice;
  Eigen::VectorXd coefficients;  // of the kind's own basis; radians, for the width metres
  Eigen::MatrixXd covariance;
  double aicc = 0;
  FunctionBasis basis;
  double value(double l) const;
  double sigma(double l) const;
};

struct OrganFit {
  MeasuredOrgan measured;
  std::string failure;  // why nothing was fitted; empty: fitted
  double length_m = 0, length_sigma_m = 0;
  double direction = 0,
         direction_sigma = 0;  // radians from x towards y; sigma NaN where it was given or fixed
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d base_covariance_m2 = Eigen::Matrix3d::Zero();
  std::map<std::string, FittedFunction>
      functions;  // inclination, azimuth, twist, width: those that were fitted
  std::map<std::string, std::vector<std::pair<FunctionChoice, double>>> aicc_table;
  double chi2 = 0;  // of the midrib
  int degrees_of_freedom = 0;
  bool errors_known = false;                // false: one sigma for all was estimated
  double sigma_m = 0;                       // that sigma
  double variance_factor = 1;               // that the midrib's covariances were multiplied by
  std::optional<double> edge_chi2_per_dof;  // absent without edges or errors
  std::optional<double> chi2_per_dof;       // absent when the errors are not known
  std::vector<int> outliers;                // numbers of midrib points left out
  std::vector<Eigen::Vector3d> points_m;    // the midrib as measured
  std::vector<Eigen::Vector3d> fitted_m;    // the fitted midrib at equal steps of l
  double rms_m = 0;                         // at equal normalised arc length, base anchored, length free
  double width_m = 0, width_sigma_m = 0;    // largest full width; NaN without edges
  std::vector<std::string> notes;
  bool edges_swapped = false;  // left and right exchanged, so that the upper face looks at the stem
  bool ok() const { return failure.empty(); }
};

OrganFit fit_organ(const MeasuredOrgan& organ, const FitOptions& options);
std::vector<OrganFit> fit_organs(const std::vector<MeasuredOrgan>& organs, const FitOptions& options);

}  // namespace bpms
