#include "calibrate/adjustment/normal_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>

#include "calibrate/lenses/lens.h"

namespace bpms {
namespace {

struct Columns {
  std::vector<Eigen::Index> lens, pose;  // first column of each camera's; pose of camera 0: none (-1)
  Eigen::Index bending = -1;
  Eigen::Index count = 0;
};

Columns columns_of(const BundleProblem& problem, const BundleState& state) {
  Columns out;
  for (std::size_t c = 0; c < state.cameras.size(); ++c) {
    out.lens.push_back(out.count);
    out.count += static_cast<Eigen::Index>(state.cameras[c].parameters.size());
    out.pose.push_back(c == 0 ? -1 : out.count);
    if (c > 0) out.count += 6;
  }
  if (problem.free_bending) out.bending = out.count, out.count += 2;
  return out;
}

struct FrameSums {
  Eigen::MatrixXd n_aa, n_ap;
  Eigen::Matrix<double, 6, 6> n_pp = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::VectorXd g_a;
  Eigen::Matrix<double, 6, 1> g_p = Eigen::Matrix<double, 6, 1>::Zero();
};

void add(const BundleProblem& problem, const BundleState& state, const Columns& columns,
         const CornerObservation& corner, FrameSums& sums, double& squared) {
  const auto c = static_cast<std::size_t>(corner.camera);
  const Pose& board = state.rig_from_board[static_cast<std::size_t>(corner.frame)];
  const Eigen::Vector3d turned = board.r * board_point(problem, state, corner.point);
  const auto at = project_with_derivatives(state.cameras[c], turned + board.t_m);
  if (!at) throw Error(ErrorKind::internal, "a used corner of the adjustment does not project");
  Eigen::Matrix<double, 2, Eigen::Dynamic> a =
      Eigen::Matrix<double, 2, Eigen::Dynamic>::Zero(2, columns.count);
  a.middleCols(columns.lens[c], at->by_parameters.cols()) = at->by_parameters;
  if (columns.pose[c] >= 0) a.middleCols<6>(columns.pose[c]) = at->by_pose;
  if (columns.bending >= 0)
    a.middleCols<2>(columns.bending) =
        at->by_point * board.r.col(2) * problem.bending[static_cast<std::size_t>(corner.point)].transpose();
  Eigen::Matrix<double, 2, 6> p;
  p << -at->by_point * cross_matrix(turned), at->by_point;
  const Eigen::Vector2d r = corner.pixel - at->pixel;
  sums.n_aa.noalias() += a.transpose() * a;
  sums.n_ap.noalias() += a.transpose() * p;
  sums.n_pp.noalias() += p.transpose() * p;
  sums.g_a.noalias() += a.transpose() * r;
  sums.g_p.noalias() += p.transpose() * r;
  squared += r.squaredNorm();
}

// Adds what the lens models say beforehand. Returns how many of the columns the corners determine: all, but
// of what is held none, and with priors the trace of (corners' information) (all information)^-1.
double add_lens_priors(const BundleState& state, const Columns& columns, NormalEquations& out) {
  const Eigen::MatrixXd corners = out.information;
  out.known_score.setZero(columns.count);
  bool any = false;
  for (std::size_t c = 0; c < state.cameras.size(); ++c) {
    const Camera& camera = state.cameras[c];
    const Lens& lens = *find_lens(camera.model);
    const LensNumbers numbers{camera.parameters, camera.constants};
    const Eigen::Index first = columns.lens[c];
    for (const LensPrior& prior : lens.priors(numbers)) {
      any = true;
      double r = prior.value;
      for (const auto& [i, a] : prior.coefficients) r -= a * camera.parameters[static_cast<std::size_t>(i)];
      const double weight = std::pow(prior_sigma_px / prior.sigma, 2);
      for (const auto& [i, a] : prior.coefficients) {
        out.known_score[first + i] += weight * a * r;
        for (const auto& [j, b] : prior.coefficients) out.information(first + i, first + j) += weight * a * b;
      }
    }
    for (const int i : lens.held(numbers)) {  // known: no variance, and tied to nothing
      any = true;
      out.information.row(first + i).setZero();
      out.information.col(first + i).setZero();
      constexpr double known = 1e30;
      out.information(first + i, first + i) = known;
      out.known_score[first + i] = 0;
      for (auto& frame : out.frames) frame.score[first + i] = 0;
    }
  }
  if (!any) return static_cast<double>(columns.count);
  const Eigen::VectorXd scale = out.information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd all = scale.asDiagonal() * out.information * scale.asDiagonal(),
                        seen = scale.asDiagonal() * corners * scale.asDiagonal();
  return all.ldlt().solve(seen).trace();
}

}  // namespace

Eigen::VectorXd NormalEquations::score() const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(information.rows());
  for (const Frame& frame : frames) out += frame.score;
  if (known_score.size() > 0) out += known_score;
  return out;
}

double NormalEquations::rms_px() const {
  return observations > 0 ? std::sqrt(squared_residuals / observations) : 0;
}

double NormalEquations::sigma_px() const {
  return observations > parameters ? std::sqrt(squared_residuals / (observations - parameters)) : 0;
}

NormalEquations normal_equations(const BundleProblem& problem, const BundleState& state) {
  const Columns columns = columns_of(problem, state);
  NormalEquations out;
  for (std::size_t c = 0; c < state.cameras.size(); ++c) {
    std::vector<std::string> names = parameter_names(state.cameras[c]);
    if (c == 0) names.resize(state.cameras[c].parameters.size());
    for (const std::string& name : names) out.order.push_back(state.cameras[c].name + "." + name);
  }
  out.bending = problem.free_bending ? 2 : 0;
  std::map<int, FrameSums> frames;
  for (const CornerObservation& corner : problem.corners) {
    if (!corner.used) continue;
    const auto [at, fresh] = frames.try_emplace(corner.frame);
    FrameSums& sums = at->second;
    if (fresh) {
      sums.n_aa.setZero(columns.count, columns.count);
      sums.n_ap.setZero(columns.count, 6);
      sums.g_a.setZero(columns.count);
    }
    add(problem, state, columns, corner, sums, out.squared_residuals);
    out.observations += 2;
  }
  out.information.setZero(columns.count, columns.count);
  for (const auto& [frame, sums] : frames) {
    const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> pose(sums.n_pp);
    if (pose.info() != Eigen::Success || !pose.isPositive())
      throw Error(ErrorKind::numeric, "the corners of a frame do not determine the pose of the board");
    const Eigen::MatrixXd eliminated = pose.solve(sums.n_ap.transpose());
    const Eigen::Matrix<double, 6, 1> step = pose.solve(sums.g_p);
    out.information += sums.n_aa - sums.n_ap * eliminated;
    out.frames.push_back({frame, sums.g_a - sums.n_ap * step});
    out.pose_decrement += sums.g_p.dot(step);
  }
  const double free = add_lens_priors(state, columns, out);
  out.parameters = static_cast<int>(std::lround(free)) + 6 * static_cast<int>(frames.size());
  return out;
}

Eigen::MatrixXd cofactors(const NormalEquations& equations) {
  const Eigen::MatrixXd& n = equations.information;
  const Eigen::VectorXd diagonal = n.diagonal();
  const auto name = [&](Eigen::Index i) {
    const auto k = static_cast<std::size_t>(i);
    return k < equations.order.size() ? equations.order[k] : std::string("the bending of the board");
  };
  Eigen::Index worst = 0;
  constexpr double least_reciprocal_condition = 1e-13;
  if (diagonal.minCoeff(&worst) > 0 && n.allFinite()) {
    const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * n * scale.asDiagonal());
    if (eigen.eigenvalues()[0] > least_reciprocal_condition * eigen.eigenvalues()[n.rows() - 1]) {
      const Eigen::MatrixXd half = scale.asDiagonal() * eigen.eigenvectors() *
                                   eigen.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
      return half * half.transpose();
    }
    eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&worst);
  }
  fail(ErrorKind::numeric, {},
       "the views do not determine {}: show the target tilted by 30 to 45 degrees in several directions, "
       "over the whole "
       "image, or ask for fewer lens parameters",
       name(worst));
}

Eigen::MatrixXd sandwich(const NormalEquations& equations, const Eigen::MatrixXd& cofactors) {
  Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(cofactors.rows(), cofactors.cols());
  for (const auto& frame : equations.frames) middle += frame.score * frame.score.transpose();
  const double f = static_cast<double>(equations.frames.size());
  return cofactors * middle * cofactors * (f / (f - 1));
}

}  // namespace bpms
