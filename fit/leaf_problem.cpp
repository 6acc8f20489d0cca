#include "fit/leaf_problem.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace bpms {
namespace {

// Until the data tell, points without stated errors are taken to be good to this part of the length.
constexpr double nominal_sigma = 1e-3;

Eigen::Matrix3d whitening(const VectorPoint& point, double scale_m, bool planar, bool known) {
  if (!known) {
    Eigen::Matrix3d w = Eigen::Matrix3d::Identity() / nominal_sigma;
    if (planar) w(1, 1) = 0;
    return w;
  }
  Eigen::Matrix3d covariance = point.covariance_m2 / (scale_m * scale_m);
  if (planar) {
    covariance.row(1).setZero();
    covariance.col(1).setZero();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
  // A covariance that says a direction is free of error is taken at a millionth of its largest sigma.
  const double least = 1e-12 * eigen.eigenvalues().maxCoeff();
  const Eigen::Vector3d inverse = eigen.eigenvalues().cwiseMax(least).cwiseSqrt().cwiseInverse();
  Eigen::Matrix3d w = inverse.asDiagonal() * eigen.eigenvectors().transpose();
  if (planar) w.col(1).setZero();
  return w;
}

LeafObservation observation(const VectorPoint& point, LeafCurve curve, const LeafProblem& problem) {
  LeafObservation o;
  o.curve = curve;
  o.x = point.x_m / problem.scale_m;
  o.whitening = whitening(point, problem.scale_m, problem.planar, problem.errors_known);
  o.dimensions = problem.planar ? 2 : 3;
  return o;
}

// Arc length of the polyline at each point, not normalised.
std::vector<double> arc_lengths(const std::vector<VectorPoint>& points) {
  std::vector<double> out{0};
  for (std::size_t k = 1; k < points.size(); ++k)
    out.push_back(out.back() + (points[k].x_m - points[k - 1].x_m).norm());
  return out;
}

bool errors_of(const MeasuredOrgan& organ) {
  std::size_t with = 0, all = 0;
  const VectorPoint* without = nullptr;
  for (const auto* list : {&organ.midrib, &organ.edge_left, &organ.edge_right}) {
    for (const VectorPoint& p : *list) {
      ++all;
      if (p.covariance_m2.trace() > 0)
        ++with;
      else
        without = &p;
    }
  }
  if (with != 0 && with != all)
    bad_input(without->where, "{}: this point has no covariance, others of the organ have", organ.str());
  return with != 0;
}

// From the base to the middle of the leaf, in the horizontal; for a leaf that ends above its base, the widest
// way.
double outward_direction(const std::vector<VectorPoint>& points, const std::vector<double>& arc) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (std::size_t k = 1; k < points.size(); ++k) {
    const Eigen::Vector2d middle = ((points[k].x_m + points[k - 1].x_m) / 2 - points[0].x_m).head<2>();
    mean += middle * (arc[k] - arc[k - 1]) / arc.back();
    spread += middle * middle.transpose() * (arc[k] - arc[k - 1]) / arc.back();
  }
  constexpr double little = 0.2;
  if (mean.squaredNorm() > little * spread.trace()) return std::atan2(mean.y(), mean.x());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(spread);
  Eigen::Vector2d axis = eigen.eigenvectors().col(1);
  if (axis.dot(mean) < 0) axis = -axis;
  return std::atan2(axis.y(), axis.x());
}

// The polyline's point at arc length s.
Eigen::Vector3d along(const std::vector<LeafObservation>& midrib, double l) {
  std::size_t k = 1;
  while (k + 1 < midrib.size() && midrib[k].l < l) ++k;
  const double width = midrib[k].l - midrib[k - 1].l;
  const double f = width > 0 ? (l - midrib[k - 1].l) / width : 0.0;
  return midrib[k - 1].x + f * (midrib[k].x - midrib[k - 1].x);
}

void unwrap(std::vector<double>& angle) {
  for (std::size_t k = 1; k < angle.size(); ++k)
    angle[k] -= 2 * pi * std::round((angle[k] - angle[k - 1]) / (2 * pi));
}

}  // namespace

std::optional<LeafProblem> leaf_problem(const MeasuredOrgan& organ, const FitOptions& options,
                                        std::string& failure) {
  constexpr std::size_t least_points = 4;
  std::size_t distinct = organ.midrib.empty() ? 0 : 1;
  for (std::size_t k = 1; k < organ.midrib.size(); ++k) {
    if (organ.midrib[k].x_m != organ.midrib[k - 1].x_m) ++distinct;
  }
  if (distinct < least_points) {
    failure =
        fmt::format("{} midrib points in different places, at least {} are needed", distinct, least_points);
    return std::nullopt;
  }
  for (const auto* list : {&organ.midrib, &organ.edge_left, &organ.edge_right}) {
    for (const VectorPoint& p : *list)
      if (!p.x_m.allFinite() || !p.covariance_m2.allFinite())
        bad_input(p.where, "{}: a coordinate is not a number", organ.str());
  }
  const std::vector<double> arc = arc_lengths(organ.midrib);
  LeafProblem out;
  out.scale_m = arc.back();
  out.planar = organ.planar;
  out.errors_known = errors_of(organ);
  out.midrib_points = organ.midrib.size();
  for (std::size_t k = 0; k < organ.midrib.size(); ++k) {
    LeafObservation o = observation(organ.midrib[k], LeafCurve::midrib, out);
    o.l = arc[k] / arc.back();
    o.place_free = out.errors_known && k > 0 && k + 1 < organ.midrib.size();
    out.midrib.push_back(o);
  }
  if (options.anchor_base || !out.errors_known) {
    out.base = out.midrib.front().x;
    out.midrib.front().weight = 0;
  } else {
    out.base_axes = out.planar ? std::vector<int>{0, 2} : std::vector<int>{0, 1, 2};
  }
  for (const VectorPoint& p : organ.edge_left) out.edges.push_back(observation(p, LeafCurve::edge_left, out));
  for (const VectorPoint& p : organ.edge_right)
    out.edges.push_back(observation(p, LeafCurve::edge_right, out));
  if (out.planar) {
    out.direction_free = false;
    if (!out.edges.empty())
      bad_input(organ.edge_left.empty() ? organ.edge_right[0].where : organ.edge_left[0].where,
                "{}: edges need y coordinates", organ.str());
  } else if (options.direction || organ.organ != "leaf") {
    // A stem stands nearly upright, where a direction about the vertical means nothing: two angles from the
    // vertical.
    out.direction_free = false;
    out.direction = options.direction.value_or(0.0);
    out.azimuth_constant = true;
  } else {
    out.direction = outward_direction(organ.midrib, arc);
  }
  return out;
}

LeafModelShape leaf_shape(const LeafProblem& problem, FunctionChoice inclination, FunctionChoice azimuth,
                          std::optional<FunctionChoice> twist, std::optional<FunctionChoice> width) {
  LeafModelShape out;
  out.inclination = FunctionBasis(inclination, true);
  if (!problem.planar && (problem.azimuth_constant || azimuth.order > 0))
    out.azimuth = FunctionBasis(azimuth, problem.azimuth_constant);
  if (twist) out.twist = FunctionBasis(*twist, true);
  if (width) out.width = FunctionBasis(*width, true);
  out.direction_free = problem.direction_free;
  out.direction = problem.direction;
  out.base_axes = problem.base_axes;
  out.base = problem.base;
  return out;
}

Eigen::VectorXd midrib_start(const LeafProblem& problem, const LeafModel& model, int pieces) {
  const LeafModelShape& shape = model.shape();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(problem.direction, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  std::vector<double> l, weight, inclination, azimuth;
  for (int k = 0; k < pieces; ++k) {
    const double from = static_cast<double>(k) / pieces, to = static_cast<double>(k + 1) / pieces;
    const Eigen::Vector3d step = turn.transpose() * (along(problem.midrib, to) - along(problem.midrib, from));
    if (step.norm() < 1e-9) continue;
    l.push_back((from + to) / 2);
    weight.push_back(1.0 / pieces);
    inclination.push_back(std::atan2(step.x(), step.z()));
    azimuth.push_back(std::asin(std::clamp(-step.y() / step.norm(), -1.0, 1.0)));
  }
  unwrap(inclination);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(model.parameters());
  out[LeafModel::at_length()] = 1;
  if (shape.direction_free) out[model.at_direction()] = problem.direction;
  for (std::size_t k = 0; k < shape.base_axes.size(); ++k)
    out[model.at_base() + static_cast<int>(k)] =
        problem.midrib.front().x[shape.base_axes[k]] - problem.base[shape.base_axes[k]];
  out.segment(model.at_inclination(), shape.inclination.size()) =
      shape.inclination.project(l, inclination, weight);
  out.segment(model.at_azimuth(), shape.azimuth.size()) = shape.azimuth.project(l, azimuth, weight);
  return out;
}

bool edge_start(LeafProblem& problem, const LeafModel& solved_midrib, std::vector<double>& l,
                std::vector<double>& twist, std::vector<double>& width) {
  constexpr int steps = 40;
  struct Seen {
    double l, twist, half;
    LeafObservation* o;
  };
  std::vector<Seen> seen;
  for (LeafObservation& o : problem.edges) {
    double best = std::numeric_limits<double>::infinity();
    LeafModel::Point point;
    for (int k = 0; k <= steps; ++k) {
      solved_midrib.point(LeafCurve::midrib, static_cast<double>(k) / steps, false, point);
      if (const double d = (o.x - point.x).squaredNorm(); d < best) {
        best = d;
        o.l = static_cast<double>(k) / steps;
      }
    }
    const Eigen::Matrix3d frame = solved_midrib.frame(o.l);
    solved_midrib.point(LeafCurve::midrib, o.l, false, point);
    const Eigen::Vector3d out =
        frame.transpose() * (o.x - point.x) * (o.curve == LeafCurve::edge_left ? 1.0 : -1.0);
    // The edges may begin below the midrib's first visible point, or end beyond its last: nothing is known
    // there.
    constexpr double beyond = 0.03;
    const double along_midrib = frame.col(2).dot(o.x - point.x);
    if ((o.l <= 0 && along_midrib < -beyond) || (o.l >= 1 && along_midrib > beyond)) {
      o.weight = 0;
      continue;
    }
    seen.push_back({o.l, std::atan2(-out.x(), out.y()), std::hypot(out.x(), out.y()), &o});
  }
  std::stable_sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.l < b.l; });
  // The upper face looks at the stem at the base: the lower third decides which edge is which.
  if (seen.empty()) return false;
  double up = 0;
  for (const Seen& s : seen) up += s.l <= seen.front().l + 1.0 / 3 ? s.half * std::cos(s.twist) : 0.0;
  const bool swapped = up < 0;
  for (const Seen& s : seen) {
    if (swapped)
      s.o->curve = s.o->curve == LeafCurve::edge_left ? LeafCurve::edge_right : LeafCurve::edge_left;
    l.push_back(s.l);
    twist.push_back(s.twist + (swapped ? pi : 0.0));
    width.push_back(2 * s.half);
  }
  if (!twist.empty()) twist[0] -= 2 * pi * std::round(twist[0] / (2 * pi));
  unwrap(twist);
  return swapped;
}

}  // namespace bpms
