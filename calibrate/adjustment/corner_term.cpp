#include "calibrate/adjustment/corner_term.h"

#include "calibrate/lenses/lens.h"

namespace bpms {
namespace {

// A pose at the start of the solve, or its small change from there.
struct Link {
  Pose start;
  int block = -1;

  Pose at(double const* const* p) const {
    if (block < 0) return start;
    const Eigen::Map<const Eigen::Vector3d> w(p[block]), t(p[block] + 3);
    return {rotation_from_vector(w) * start.r, start.t_m + t};
  }
  // d(R x + t)/d(change), from the rotated point R x.
  Eigen::Matrix<double, 3, 6> derivative(double const* const* p, const Eigen::Vector3d& rotated) const {
    Eigen::Matrix<double, 3, 6> out;
    out << -cross_matrix(rotated) * left_jacobian(Eigen::Map<const Eigen::Vector3d>(p[block])),
        Eigen::Matrix3d::Identity();
    return out;
  }
};

class CornerTerm final : public ceres::CostFunction {
 public:
  CornerTerm(const BundleProblem& problem, const BundleState& state, const CornerObservation& corner,
             const CornerBlocks& blocks)
      : pixel_(corner.pixel), camera_(state.cameras[static_cast<std::size_t>(corner.camera)]) {
    const auto t = static_cast<std::size_t>(corner.target), i = static_cast<std::size_t>(corner.point);
    lens_ = find_lens(camera_.model);
    point_ = target_point(problem, state, corner.target, corner.point);
    if (!problem.targets[t].bending.empty()) bending_ = problem.targets[t].bending[i];
    if (blocks.bending) point_.z() -= bending_.dot(state.bending_m[t]);
    if (blocks.point) point_ -= state.shifts_m[t][i];
    set_num_residuals(2);
    const auto next = [&](bool wanted, int size) {
      if (!wanted) return -1;
      mutable_parameter_block_sizes()->push_back(size);
      return static_cast<int>(parameter_block_sizes().size()) - 1;
    };
    lens_block_ = next(blocks.lens, static_cast<int>(camera_.parameters.size()));
    links_[0] = {camera_pose(camera_), next(blocks.camera, 6)};
    if (problem.rig_moves) links_[1].start = state.rig_from_world[problem.rig_slot(corner.frame)];
    turn_ = table_turn(problem, corner.frame).r;
    links_[1].block = next(blocks.rig, 6);
    links_[2] = {state.world_from_target[t][problem.slot(corner.target, corner.frame)],
                 next(blocks.target, 6)};
    bending_block_ = next(blocks.bending, 2);
    point_block_ = next(blocks.point, 3);
  }

  bool Evaluate(double const* const* p, double* residuals, double** jacobians) const override {
    Eigen::Vector3d on_target = point_;
    if (bending_block_ >= 0)
      on_target.z() += bending_.dot(Eigen::Map<const Eigen::Vector2d>(p[bending_block_]));
    if (point_block_ >= 0) on_target += Eigen::Map<const Eigen::Vector3d>(p[point_block_]);
    const std::array<Pose, 3> poses{links_[0].at(p), links_[1].at(p), links_[2].at(p)};
    std::array<Eigen::Vector3d, 3> rotated;
    Eigen::Vector3d x = on_target;
    for (std::size_t k = 3; k-- > 0;) {
      if (k == 1) x = turn_ * x;  // the table's, within the world
      rotated[k] = poses[k].r * x;
      x = rotated[k] + poses[k].t_m;
    }
    const std::span<const double> numbers = lens_block_ >= 0
                                                ? std::span(p[lens_block_], camera_.parameters.size())
                                                : std::span(camera_.parameters);
    if (jacobians == nullptr) {
      const auto pixel = lens_->project({numbers, camera_.constants}, x);
      if (!pixel) return false;  // the solver takes a shorter step
      Eigen::Map<Eigen::Vector2d>{residuals} = *pixel - pixel_;
      return true;
    }
    const auto at = lens_->project_with_derivatives({numbers, camera_.constants}, x);
    if (!at) return false;
    Eigen::Map<Eigen::Vector2d>{residuals} = at->pixel - pixel_;
    using RowMajor = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>;
    const auto put = [&](int block, const auto& matrix) {
      if (block >= 0 && jacobians[block] != nullptr)
        Eigen::Map<RowMajor>(jacobians[block], 2, matrix.cols()) = matrix;
    };
    put(lens_block_, at->by_parameters);
    Eigen::Matrix<double, 2, 3> by = at->by_x_cam;
    for (std::size_t k = 0; k < 3; ++k) {
      if (links_[k].block >= 0) put(links_[k].block, by * links_[k].derivative(p, rotated[k]));
      by = (by * poses[k].r).eval();
      if (k == 1) by = (by * turn_).eval();
    }
    put(bending_block_, by.col(2) * bending_.transpose());
    put(point_block_, by);
    return true;
  }

 private:
  Eigen::Vector2d pixel_, bending_ = Eigen::Vector2d::Zero();
  const Camera& camera_;  // what is not moved of it is read
  const Lens* lens_;
  Eigen::Matrix3d turn_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d point_;  // without what is moved
  std::array<Link, 3> links_;
  int lens_block_ = -1, bending_block_ = -1, point_block_ = -1;
};

}  // namespace

std::unique_ptr<ceres::CostFunction> corner_term(const BundleProblem& problem, const BundleState& state,
                                                 const CornerObservation& corner,
                                                 const CornerBlocks& blocks) {
  return std::make_unique<CornerTerm>(problem, state, corner, blocks);
}

}  // namespace bpms
