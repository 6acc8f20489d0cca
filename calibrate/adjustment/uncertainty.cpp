#include "calibrate/adjustment/uncertainty.h"

#include <cmath>

#include "calibrate/adjustment/bundle_adjustment.h"
#include "core/interrupt.h"
#include "core/parallel.h"

namespace bpms {
namespace {

// The solution's parameters as differences from another one, in the order of the normal equations.
Eigen::VectorXd difference(const BundleProblem& problem, const BundleState& state, const BundleState& from,
                           Eigen::Index columns) {
  Eigen::VectorXd out(columns);
  Eigen::Index at = 0;
  for (std::size_t c = 0; c < state.cameras.size(); ++c) {
    const Camera &a = state.cameras[c], &b = from.cameras[c];
    for (const std::size_t i : problem.free_parameters(static_cast<int>(c), a))
      out[at++] = a.parameters[i] - b.parameters[i];
    if (c == 0) continue;
    out.segment<3>(at) = vector_from_rotation(a.r_cam_from_rig * b.r_cam_from_rig.transpose());
    out.segment<3>(at + 3) = a.t_cam_from_rig_m - b.t_cam_from_rig_m;
    at += 6;
  }
  return out;
}

Clustered jackknife(const BundleProblem& problem, const BundleState& solution,
                    const NormalEquations& equations, const std::vector<CameraPair>& pairs) {
  const std::size_t n = equations.frames.size();
  const auto columns = static_cast<Eigen::Index>(equations.order.size()),
             count = static_cast<Eigen::Index>(pairs.size());
  Eigen::MatrixXd values(columns + count, static_cast<Eigen::Index>(n));  // a column for each frame left out
  parallel_for(n, [&](std::size_t i) {
    throw_if_interrupted();
    std::vector<bool> keep(static_cast<std::size_t>(problem.frames), true);
    keep[static_cast<std::size_t>(equations.frames[i].frame)] = false;
    const BundleState without = solve_subset(problem, solution, keep);
    Eigen::VectorXd column(columns + count);
    column.head(columns) = difference(problem, without, solution, columns);
    for (Eigen::Index p = 0; p < count; ++p) {
      const CameraPair& pair = pairs[static_cast<std::size_t>(p)];
      column[columns + p] = relative_pose(without.cameras, pair.a, pair.b).t_m.norm();
    }
    values.col(static_cast<Eigen::Index>(i)) = column;
  });
  const Eigen::VectorXd mean = values.rowwise().mean();
  const double f = static_cast<double>(n);
  const Eigen::VectorXd sigma =
      ((values.colwise() - mean).rowwise().squaredNorm() * ((f - 1) / f)).cwiseSqrt();
  Clustered out{sigma.head(columns), {}};
  for (Eigen::Index p = 0; p < count; ++p) out.baseline_sigma_m.push_back(sigma[columns + p]);
  return out;
}

}  // namespace

Pose relative_pose(const std::vector<Camera>& cameras, int a, int b) {
  const Camera &from = cameras[static_cast<std::size_t>(a)], &to = cameras[static_cast<std::size_t>(b)];
  return camera_pose(to) * camera_pose(from).inverse();
}

// t = t_b - R_ba t_a with R_ba = exp(w_b) R_ba exp(-w_a).
Eigen::VectorXd baseline_gradient(const BundleProblem& problem, const std::vector<Camera>& cameras, int a,
                                  int b, Eigen::Index columns) {
  const Pose pose = relative_pose(cameras, a, b);
  const Eigen::RowVector3d direction = pose.t_m.normalized().transpose();
  const Eigen::Vector3d& t_a = cameras[static_cast<std::size_t>(a)].t_cam_from_rig_m;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(columns);
  Eigen::Index at = 0;
  for (int c = 0; c < static_cast<int>(cameras.size()); ++c) {
    at += static_cast<Eigen::Index>(problem.free_parameters(c, cameras[static_cast<std::size_t>(c)]).size());
    if (c == 0) continue;
    if (c == a) {
      out.segment<3>(at) = (-direction * pose.r * cross_matrix(t_a)).transpose();
      out.segment<3>(at + 3) = (-direction * pose.r).transpose();
    } else if (c == b) {
      out.segment<3>(at) = (direction * cross_matrix(pose.r * t_a)).transpose();
      out.segment<3>(at + 3) = direction.transpose();
    }
    at += 6;
  }
  return out;
}

BundleState solve_subset(const BundleProblem& problem, const BundleState& start,
                         const std::vector<bool>& keep_frame) {
  BundleProblem subset = problem;
  std::erase_if(subset.corners, [&](const CornerObservation& corner) {
    return !corner.used || !keep_frame[static_cast<std::size_t>(corner.frame)];
  });
  BundleState state = start;
  constexpr double tolerance = 1e-10;  // leaves less than 1e-3 sigma
  if (subset.corners.empty() || !adjust(subset, {.tolerance = tolerance}, state).converged)
    throw Error(ErrorKind::numeric, "a solve over part of the frames did not converge");
  return state;
}

Clustered clustered_by_frame(const BundleProblem& problem, const BundleState& solution,
                             const NormalEquations& equations, const Eigen::MatrixXd& cofactors,
                             const std::vector<CameraPair>& pairs) {
  constexpr std::size_t enough_for_sandwich = 20;
  if (equations.frames.size() < enough_for_sandwich) return jackknife(problem, solution, equations, pairs);
  const Eigen::MatrixXd v = sandwich(equations, cofactors);
  const auto columns = static_cast<Eigen::Index>(equations.order.size());
  Clustered out{v.diagonal().head(columns).cwiseSqrt(), {}};
  for (const CameraPair& pair : pairs) {
    const Eigen::VectorXd gradient = baseline_gradient(problem, solution.cameras, pair.a, pair.b, v.rows());
    out.baseline_sigma_m.push_back(std::sqrt(gradient.dot(v * gradient)));
  }
  return out;
}

}  // namespace bpms
