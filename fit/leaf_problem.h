// A measured organ made ready for the solver: lengths in units of the polyline's length, errors as
// whitenings, places from the polyline's arc length, and parameters to start from.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "fit/curve_solver.h"
#include "fit/fit.h"

namespace bpms {

struct LeafProblem {
  double scale_m = 0;  // length of the midrib's polyline
  bool errors_known = false;
  bool planar = false;
  std::vector<LeafObservation> midrib, edges;  // scaled
  std::size_t midrib_points = 0;
  double direction = 0;  // from the base towards the middle of the leaf
  bool direction_free = true;
  bool azimuth_constant = false;  // the azimuth function has its constant: where the direction is not free
  std::vector<int> base_axes;
  Eigen::Vector3d base = Eigen::Vector3d::Zero();
};

// nullopt with the reason in `failure` for an organ that cannot be fitted; bad_input for errors that make no
// sense (some points of an organ with a covariance and some without).
std::optional<LeafProblem> leaf_problem(const MeasuredOrgan& organ, const FitOptions& options,
                                        std::string& failure);

// The shape with these functions; a twist or width of no function is left out.
LeafModelShape leaf_shape(const LeafProblem& problem, FunctionChoice inclination, FunctionChoice azimuth,
                          std::optional<FunctionChoice> twist, std::optional<FunctionChoice> width);

// Start for the midrib's parameters from the directions of the polyline, smoothed to `pieces` of equal arc
// length.
Eigen::VectorXd midrib_start(const LeafProblem& problem, const LeafModel& model, int pieces);
// Edge points beyond the midrib's ends lose their weight.
// Fills in twist and width, and sets the edges' places, from a solved midrib; true when the edges had to be
// swapped so that the upper side faces the stem at the base.
bool edge_start(LeafProblem& problem, const LeafModel& solved_midrib, std::vector<double>& l,
                std::vector<double>& twist, std::vector<double>& width);

}  // namespace bpms
