#include "calibrate/describe.h"

#include <cmath>

#include "core/statistics.h"
#include "core/text.h"

namespace bpms {

void describe_views(const Observations& observations, const BundleProblem& problem, const BundleState& state,
                    const OutlierSearch& search, Calibration& out) {
  std::vector<int> left_out(observations.views.size(), 0);
  for (std::size_t v = 0; v < observations.views.size(); ++v) {
    const BoardView& view = observations.views[v];
    out.views.push_back({view.image,
                         observations.cameras[static_cast<std::size_t>(view.camera)].name,
                         view.frame,
                         view.target,
                         search.view_rms_px[v],
                         search.view_out[v],
                         {},
                         {},
                         {}});
  }
  for (const CornerObservation& corner : problem.corners) {
    const auto v = static_cast<std::size_t>(corner.view);
    const auto r = residual(problem, state, corner);
    ++out.corners_total;
    if (corner.used) {
      ++out.corners_used;
      out.views[v].residuals.emplace_back(corner.pixel.x(), corner.pixel.y(), r->x(), r->y());
      out.views[v].points.push_back(corner.point);
    } else {
      ++left_out[v];
      out.outliers.push_back({out.views[v].image, corner.point, r ? r->norm() : NAN});
    }
  }
  for (std::size_t v = 0; v < out.views.size(); ++v) {
    if (!out.views[v].outlier) continue;
    out.views[v].reason = fmt::format(
        "residual rms {:.3g} px against {:.3g} px of the used corners; {} of {} corners left out",
        out.views[v].rms_px, out.residual_rms_px, left_out[v], observations.views[v].corners.size());
  }
}

void describe_targets(const Observations& observations, const BundleProblem& problem,
                      const BundleState& state, Calibration& out) {
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    const NetworkTarget& target = problem.targets[t];
    Calibration::TargetResult result;
    result.name = target.name;
    result.warp_m = state.bending_m[t];
    result.stands = target.stands;
    for (const BoardView& view : observations.views)
      result.views += view.target == static_cast<int>(t) ? 1 : 0;
    const auto point = [&](int i) { return target_point(problem, state, static_cast<int>(t), i); };
    if (target.known != PointsKnown::exact)
      for (int i = 0; i < static_cast<int>(target.points_m.size()); ++i) result.points_m.push_back(point(i));
    for (const ScaleBar& bar : target.bars)
      result.bars.push_back({bar, (point(bar.a) - point(bar.b)).norm()});
    out.targets.push_back(std::move(result));
  }
}

Rig::Covariance rig_covariance(const NormalEquations& equations, const Eigen::MatrixXd& cofactors,
                               const Eigen::VectorXd& sigma_iid, const Eigen::VectorXd& sigma,
                               const std::string& kind) {
  const auto n = static_cast<Eigen::Index>(equations.order.size());
  const Eigen::VectorXd scale = (sigma_iid.array() > 0).select(sigma.cwiseQuotient(sigma_iid), 0.0);
  const double variance = std::pow(equations.sigma_px(), 2);
  Eigen::MatrixXd matrix =
      scale.asDiagonal() * (variance * cofactors.topLeftCorner(n, n)) * scale.asDiagonal();
  matrix = 0.5 * (matrix + matrix.transpose().eval());
  return {equations.order, matrix, kind};
}

std::vector<double> usual_ranges(const BundleProblem& problem, const BundleState& state) {
  std::vector<std::vector<double>> ranges(state.cameras.size());
  for (const CornerObservation& corner : problem.corners) {
    if (!corner.used) continue;
    const auto c = static_cast<std::size_t>(corner.camera);
    const Pose place = rig_from_target(problem, state, corner.target, corner.frame);
    ranges[c].push_back(
        state.cameras[c]
            .camera_from_rig(place * target_point(problem, state, corner.target, corner.point))
            .norm());
  }
  std::vector<double> out;
  for (std::vector<double>& of : ranges) out.push_back(of.empty() ? 0 : median(std::move(of)));
  return out;
}

}  // namespace bpms
