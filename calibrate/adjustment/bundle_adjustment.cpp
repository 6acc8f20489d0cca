#include "calibrate/adjustment/bundle_adjustment.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "calibrate/lenses/lens.h"
#include "core/statistics.h"

namespace bpms {
namespace {

Pose camera_pose(const Camera& camera) {
  return {camera.r_cam_from_rig, camera.t_cam_from_rig_m};
}

// Poses as the solver moves them: a small left rotation and a translation about the pose at the start, which
// keeps the rotation vector far from its singular angle.
struct MovingPose {
  std::array<double, 6> change{};  // rotation vector, then translation
  Pose start;

  static Pose at(const Pose& start, const double* change) {
    const Eigen::Map<const Eigen::Vector3d> w(change), t(change + 3);
    return {rotation_from_vector(w) * start.r, start.t_m + t};
  }
  // d(R x + t)/d(change), from the rotated point R x.
  static Eigen::Matrix<double, 3, 6> derivative(const double* change, const Eigen::Vector3d& rotated) {
    Eigen::Matrix<double, 3, 6> out;
    out << -cross_matrix(rotated) * left_jacobian(Eigen::Map<const Eigen::Vector3d>(change)),
        Eigen::Matrix3d::Identity();
    return out;
  }
};

// Blocks: lens parameters, camera pose, board pose, bending.
class CornerResidual final : public ceres::CostFunction {
 public:
  CornerResidual(const CornerObservation& corner, const BundleProblem& problem, const Camera& lens,
                 const Pose& camera, const Pose& board)
      : pixel_(corner.pixel),
        point_(problem.points_m[static_cast<std::size_t>(corner.point)]),
        bending_(problem.bending[static_cast<std::size_t>(corner.point)]),
        lens_(*find_lens(lens.model)),
        constants_(lens.constants),
        count_(lens.parameters.size()),
        camera_(camera),
        board_(board) {
    set_num_residuals(2);
    *mutable_parameter_block_sizes() = {static_cast<int>(count_), 6, 6, 2};
  }

  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    const Pose cam_from_rig = MovingPose::at(camera_, p[1]), rig_from_board = MovingPose::at(board_, p[2]);
    const Eigen::Vector3d on_board =
        point_ + Eigen::Vector3d(0, 0, bending_[0] * p[3][0] + bending_[1] * p[3][1]);
    const Eigen::Vector3d turned = rig_from_board.r * on_board, in_rig = turned + rig_from_board.t_m;
    const Eigen::Vector3d rotated = cam_from_rig.r * in_rig;
    const auto at = lens_.project_with_derivatives({{p[0], count_}, constants_}, rotated + cam_from_rig.t_m);
    if (!at) return false;  // the solver takes a shorter step
    Eigen::Map<Eigen::Vector2d>{residuals} = at->pixel - pixel_;
    if (jacobians == nullptr) return true;
    using RowMajor = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>;
    const auto put = [&](int block, const auto& matrix) {
      if (jacobians[block] != nullptr) Eigen::Map<RowMajor>(jacobians[block], 2, matrix.cols()) = matrix;
    };
    const Eigen::Matrix<double, 2, 3> by_rig = at->by_x_cam * cam_from_rig.r;
    put(0, at->by_parameters);
    put(1, at->by_x_cam * MovingPose::derivative(p[1], rotated));
    put(2, by_rig * MovingPose::derivative(p[2], turned));
    put(3, by_rig * rig_from_board.r.col(2) * bending_.transpose());
    return true;
  }

 private:
  Eigen::Vector2d pixel_;
  Eigen::Vector3d point_;
  Eigen::Vector2d bending_;
  const Lens& lens_;
  std::vector<double> constants_;
  std::size_t count_;
  Pose camera_, board_;
};

// What the lens model says beforehand; a deviation of one sigma counts as prior_sigma_px.
class LensPriorTerm final : public ceres::CostFunction {
 public:
  LensPriorTerm(std::vector<LensPrior> priors, std::size_t count)
      : priors_(std::move(priors)), count_(static_cast<Eigen::Index>(count)) {
    set_num_residuals(static_cast<int>(priors_.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(count));
  }
  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    const bool jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    if (jacobian) std::fill_n(jacobians[0], count_ * num_residuals(), 0.0);
    for (std::size_t row = 0; row < priors_.size(); ++row) {
      const LensPrior& prior = priors_[row];
      const double weight = prior_sigma_px / prior.sigma;
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
};

void add_lens_knowledge(Camera& camera, ceres::Problem& problem) {
  double* block = camera.parameters.data();
  if (!problem.HasParameterBlock(block)) return;
  const Lens& lens = *find_lens(camera.model);
  const LensNumbers numbers{camera.parameters, camera.constants};
  if (const auto held = lens.held(numbers); !held.empty())
    problem.SetManifold(block, new ceres::SubsetManifold(static_cast<int>(camera.parameters.size()), held));
  if (auto priors = lens.priors(numbers); !priors.empty())
    problem.AddResidualBlock(new LensPriorTerm(std::move(priors), camera.parameters.size()), nullptr, block);
}

ceres::Solver::Summary solve(ceres::Problem& problem, const AdjustOptions& options,
                             const std::vector<MovingPose>& boards) {
  ceres::Solver::Options settings;
  settings.linear_solver_type = ceres::DENSE_SCHUR;
  settings.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  std::vector<double*> blocks;
  problem.GetParameterBlocks(&blocks);
  for (double* block : blocks) {
    const bool board = std::any_of(boards.begin(), boards.end(),
                                   [&](const MovingPose& pose) { return pose.change.data() == block; });
    settings.linear_solver_ordering->AddElementToGroup(block, board ? 0 : 1);
  }
  settings.max_num_iterations = options.most_iterations;
  settings.max_num_consecutive_invalid_steps = 50;
  settings.function_tolerance = options.tolerance;
  settings.parameter_tolerance = 1e-13;
  settings.gradient_tolerance = 1e-13;
  settings.num_threads = 1;
  settings.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(settings, &problem, &summary);
  return summary;
}

}  // namespace

Eigen::Vector3d board_point(const BundleProblem& problem, const BundleState& state, int point) {
  const auto i = static_cast<std::size_t>(point);
  return problem.points_m[i] + Eigen::Vector3d(0, 0, problem.bending[i].dot(state.bending_m));
}

std::optional<Eigen::Vector2d> residual(const BundleProblem& problem, const BundleState& state,
                                        const CornerObservation& corner) {
  const Camera& camera = state.cameras[static_cast<std::size_t>(corner.camera)];
  const Pose& board = state.rig_from_board[static_cast<std::size_t>(corner.frame)];
  const auto pixel =
      project(camera, camera.camera_from_rig(board * board_point(problem, state, corner.point)));
  if (!pixel) return std::nullopt;
  return corner.pixel - *pixel;
}

double robust_sigma(const BundleProblem& problem, const BundleState& state) {
  std::vector<double> sizes;
  for (const CornerObservation& corner : problem.corners) {
    if (!corner.used) continue;
    const auto r = residual(problem, state, corner);
    for (int axis = 0; axis < 2; ++axis) sizes.push_back(r ? std::abs((*r)[axis]) : HUGE_VAL);
  }
  if (sizes.empty()) return 0;
  constexpr double median_of_half_normal = 0.6745;
  return median(std::move(sizes)) / median_of_half_normal;
}

AdjustResult adjust(const BundleProblem& problem, const AdjustOptions& options, BundleState& state) {
  // A rejected step is no news for the user. Set once: adjustments run side by side.
  [[maybe_unused]] static const int silent = FLAGS_minloglevel = google::GLOG_FATAL;
  std::vector<MovingPose> cameras, boards;
  for (const Camera& camera : state.cameras) cameras.push_back({{}, camera_pose(camera)});
  for (const Pose& pose : state.rig_from_board) boards.push_back({{}, pose});
  const std::unique_ptr<ceres::LossFunction> loss(
      options.cauchy_px > 0 ? new ceres::CauchyLoss(options.cauchy_px) : nullptr);

  ceres::Problem::Options ownership;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem ceres_problem(ownership);
  for (const CornerObservation& corner : problem.corners) {
    if (!corner.used) continue;
    const auto c = static_cast<std::size_t>(corner.camera), f = static_cast<std::size_t>(corner.frame);
    std::vector<double>& parameters = state.cameras[c].parameters;
    ceres_problem.AddResidualBlock(
        new CornerResidual(corner, problem, state.cameras[c], cameras[c].start, boards[f].start), loss.get(),
        parameters.data(), cameras[c].change.data(), boards[f].change.data(), state.bending_m.data());
  }
  for (Camera& camera : state.cameras) add_lens_knowledge(camera, ceres_problem);
  if (ceres_problem.HasParameterBlock(cameras[0].change.data()))
    ceres_problem.SetParameterBlockConstant(cameras[0].change.data());
  if (!problem.free_bending) ceres_problem.SetParameterBlockConstant(state.bending_m.data());

  const ceres::Solver::Summary summary = solve(ceres_problem, options, boards);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Pose pose = MovingPose::at(cameras[i].start, cameras[i].change.data());
    state.cameras[i].r_cam_from_rig = orthonormalised(pose.r);
    state.cameras[i].t_cam_from_rig_m = pose.t_m;
  }
  for (std::size_t i = 0; i < boards.size(); ++i) {
    const Pose pose = MovingPose::at(boards[i].start, boards[i].change.data());
    state.rig_from_board[i] = {orthonormalised(pose.r), pose.t_m};
  }
  return {summary.termination_type == ceres::CONVERGENCE, static_cast<int>(summary.iterations.size())};
}

}  // namespace bpms
