#include "calibrate/check_problem.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "calibrate/adjustment/view_pose.h"

namespace bpms {
namespace {

struct ShotState {
  std::vector<Pose> rig_from_board;
  Eigen::Vector2d bending_m = Eigen::Vector2d::Zero();
  double log_scale = 0;
  Eigen::VectorXd errors;  // of the rig, in units of the root's columns
};

struct ShotEquations {
  Eigen::MatrixXd normal;
  Eigen::VectorXd score;
  double cost = 0;     // squared residuals / sigma^2 + squared errors of the rig
  double squared = 0;  // residuals alone
};

struct ShotColumns {
  Eigen::Index common = 0, of_frame = 0, errors = 0, poses = 0, bending = -1, scale = -1, count = 0;
  ShotColumns(const RigErrors& rig, const Shot& shot, const ShotFitOptions& options) {
    common = rig.root.cols();
    of_frame = rig.frame_root.cols();
    errors = common + shot.frames * of_frame;
    poses = errors;
    count = errors + 6 * shot.frames;
    if (options.bending) bending = count, count += 2;
    if (options.scale) scale = count++;
  }
};

Eigen::Vector3d shot_point(const Shot& shot, const ShotState& state, int point) {
  const auto i = static_cast<std::size_t>(point);
  Eigen::Vector3d x = std::exp(state.log_scale) * shot.points_m[i];
  x.z() += shot.bending[i].dot(state.bending_m);
  return x;
}

// nullopt where the state projects a corner nowhere. The rig's errors move the corners to first order.
std::optional<ShotEquations> shot_equations(const Rig& rig, const RigErrors& errors, const Shot& shot,
                                            const ShotFitOptions& options, const ShotState& state) {
  const ShotColumns columns(errors, shot, options);
  ShotEquations out;
  out.normal.setZero(columns.count, columns.count);
  out.score.setZero(columns.count);
  const double weight = 1 / options.sigma_px;
  for (const ShotCorner& corner : shot.corners) {
    const auto c = static_cast<std::size_t>(corner.camera);
    const Pose& board = state.rig_from_board[static_cast<std::size_t>(corner.frame)];
    const Eigen::Vector3d x = shot_point(shot, state, corner.point), turned = board.r * x;
    const auto at = project_with_derivatives(rig.cameras[c], turned + board.t_m);
    if (!at) return std::nullopt;
    Eigen::Matrix<double, 2, Eigen::Dynamic> j =
        Eigen::Matrix<double, 2, Eigen::Dynamic>::Zero(2, columns.count);
    for (std::size_t row = 0; row < errors.rows.size(); ++row) {
      const RigErrors::Row& number = errors.rows[row];
      if (number.camera != corner.camera) continue;
      const Eigen::Vector2d by = number.parameter >= 0
                                     ? Eigen::Vector2d(at->by_parameters.col(number.parameter))
                                     : Eigen::Vector2d(at->by_pose.col(number.pose));
      const auto at_row = static_cast<Eigen::Index>(row);
      j.leftCols(columns.common) += by * errors.root.row(at_row);
      if (columns.of_frame > 0)
        j.middleCols(columns.common + corner.frame * columns.of_frame, columns.of_frame) +=
            by * errors.frame_root.row(at_row);
    }
    const Eigen::Vector2d r = corner.pixel - at->pixel - j.leftCols(columns.errors) * state.errors;
    j.middleCols<3>(columns.poses + 6 * corner.frame) = -at->by_point * cross_matrix(turned);
    j.middleCols<3>(columns.poses + 6 * corner.frame + 3) = at->by_point;
    const auto i = static_cast<std::size_t>(corner.point);
    if (columns.bending >= 0)
      j.middleCols<2>(columns.bending) = at->by_point * board.r.col(2) * shot.bending[i].transpose();
    if (columns.scale >= 0)
      j.col(columns.scale) = at->by_point * board.r * (std::exp(state.log_scale) * shot.points_m[i]);
    j *= weight;
    out.normal.noalias() += j.transpose() * j;
    out.score.noalias() += j.transpose() * (weight * r);
    out.squared += r.squaredNorm();
  }
  for (Eigen::Index k = 0; k < columns.errors; ++k) {
    out.normal(k, k) += 1;
    out.score[k] -= state.errors[k];
  }
  out.cost = weight * weight * out.squared + state.errors.squaredNorm();
  return out;
}

void step_by(const ShotColumns& columns, const Eigen::VectorXd& step, ShotState& state) {
  state.errors += step.head(columns.errors);
  for (std::size_t f = 0; f < state.rig_from_board.size(); ++f) {
    const Eigen::Index at = columns.poses + 6 * static_cast<Eigen::Index>(f);
    Pose& pose = state.rig_from_board[f];
    pose.r = orthonormalised(rotation_from_vector(step.segment<3>(at)) * pose.r);
    pose.t_m += step.segment<3>(at + 3);
  }
  if (columns.bending >= 0) state.bending_m += step.segment<2>(columns.bending);
  if (columns.scale >= 0) state.log_scale += step[columns.scale];
}

// From the camera that shows most corners of the frame, by its rays.
Pose first_board_pose(const Rig& rig, const Shot& shot, int frame) {
  std::map<int, std::vector<PointPair>> seen;
  for (const ShotCorner& corner : shot.corners) {
    if (corner.frame != frame) continue;
    const auto ray = unproject(rig.cameras[static_cast<std::size_t>(corner.camera)], corner.pixel);
    if (!ray || !(ray->z() > 0)) continue;
    seen[corner.camera].push_back(
        {shot.points_m[static_cast<std::size_t>(corner.point)], ray->hnormalized()});
  }
  const auto most = std::max_element(seen.begin(), seen.end(), [](const auto& a, const auto& b) {
    return a.second.size() < b.second.size();
  });
  const auto view = most == seen.end() ? std::nullopt : view_projection(most->second);
  if (!view) fail(ErrorKind::numeric, {}, "the corners of a frame do not determine where the board is");
  const Camera& camera = rig.cameras[static_cast<std::size_t>(most->first)];
  return Pose{camera.r_cam_from_rig, camera.t_cam_from_rig_m}.inverse() * camera_from_target(*view, 1);
}

}  // namespace

RigErrors rig_errors_of(const Rig& rig) {
  RigErrors out;
  if (!rig.covariance) return out;
  for (const std::string& name : rig.covariance->order) {
    RigErrors::Row row;
    for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
      const std::string prefix = rig.cameras[c].name + ".";
      if (!name.starts_with(prefix)) continue;
      const std::vector<std::string> names = parameter_names(rig.cameras[c]);
      const auto at = std::find(names.begin(), names.end(), name.substr(prefix.size())) - names.begin();
      const auto lens = static_cast<std::ptrdiff_t>(rig.cameras[c].parameters.size());
      if (at >= static_cast<std::ptrdiff_t>(names.size())) continue;
      row = {static_cast<int>(c), at < lens ? static_cast<int>(at) : -1,
             at < lens ? -1 : static_cast<int>(at - lens)};
    }
    if (row.parameter < 0 && row.pose < 0)
      bad_input({}, "the rig's covariance names {}, which is no number of its cameras", in_quotes(name));
    out.rows.push_back(row);
  }
  // As correlations: the numbers' sizes differ by many orders of magnitude.
  const Rig::Covariance& known = *rig.covariance;
  const Eigen::MatrixXd& c = known.matrix;
  const Eigen::VectorXd sigma = c.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd scale = (sigma.array() > 0).select(sigma.cwiseInverse(), 0.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * c * scale.asDiagonal());
  const Eigen::MatrixXd half =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal().toDenseMatrix();
  out.root = sigma.asDiagonal() * half;
  out.frame_root.resize(c.rows(), 0);
  if (known.kind != "clustered" || known.frames < 1 || known.sigma_iid.size() != sigma.size()) return out;
  // One factor for all numbers: factors of their own would undo what cancels between them (a turn of a camera
  // and its principal point), and a camera turned by half a degree would pass.
  const Eigen::VectorXd& iid = known.sigma_iid;
  const Eigen::ArrayXd ratio = (iid.array() > 0).select(sigma.array() / iid.array(), 1.0);
  const double factor = std::max(1.0, ratio.square().mean());
  out.root = std::sqrt(factor) * (iid.asDiagonal() * half);
  out.frame_root = std::sqrt(known.frames * (factor - 1)) * (iid.asDiagonal() * half);
  return out;
}

ShotFit fit_shot(const Rig& rig, const RigErrors& errors, const Shot& shot, const ShotFitOptions& options) {
  ShotState state;
  for (int f = 0; f < shot.frames; ++f) state.rig_from_board.push_back(first_board_pose(rig, shot, f));
  const ShotColumns columns(errors, shot, options);
  state.errors.setZero(columns.errors);
  auto at = shot_equations(rig, errors, shot, options, state);
  if (!at) fail(ErrorKind::numeric, {}, "the board of the shot lies outside what the rig's cameras see");
  constexpr int most_steps = 100;
  constexpr double converged = 1e-9;  // a step that takes less than this off a chi-square
  double damping = 1e-6;
  for (int i = 0; i < most_steps; ++i) {
    Eigen::MatrixXd damped = at->normal;
    damped.diagonal() *= 1 + damping;
    const Eigen::VectorXd step = damped.ldlt().solve(at->score);
    const double predicted = step.dot(at->score);
    if (!step.allFinite()) break;
    ShotState trial = state;
    step_by(columns, step, trial);
    const auto there = shot_equations(rig, errors, shot, options, trial);
    if (there && there->cost <= at->cost) {
      state = trial;
      at = there;
      damping = std::max(damping / 10, 1e-12);
    } else {
      damping = std::max(damping * 10, 1e-6);
    }
    if (predicted < converged) break;
  }
  ShotFit out;
  out.chi2 = at->cost;
  out.coordinates = 2 * static_cast<int>(shot.corners.size());
  out.rms_px = std::sqrt(at->squared / out.coordinates);
  out.rig_from_board = state.rig_from_board;
  out.bending_m = state.bending_m;
  out.log_scale = state.log_scale;
  if (columns.scale >= 0) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(columns.count, columns.scale);
    out.log_scale_sigma = std::sqrt(std::max(0.0, at->normal.ldlt().solve(unit)[columns.scale]));
  }
  return out;
}

}  // namespace bpms
