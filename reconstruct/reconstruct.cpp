#include "reconstruct/reconstruct.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/interrupt.h"
#include "core/nearest.h"
#include "core/parallel.h"
#include "reconstruct/points/gate.h"
#include "reconstruct/points/rig_errors.h"
#include "reconstruct/points/triangulation.h"

namespace bpms {

std::string ReconstructedPoint::str() const {
  return fmt::format("{} point {}", label.str(), point);
}

std::vector<VectorPoint> Vectors::accepted() const {
  std::vector<VectorPoint> out;
  for (const ReconstructedPoint& p : points) {
    if (p.accepted())
      out.push_back({p.label, p.point, p.estimate->x_m, p.estimate->covariance_m2(), p.where});
  }
  return out;
}

std::size_t Vectors::refused() const {
  std::size_t count = 0;
  for (const ReconstructedPoint& p : points) count += p.accepted() ? 0 : 1;
  return count;
}

double Vectors::reprojection_rms_px() const {
  double sum = 0;
  std::size_t count = 0;
  for (const ReconstructedPoint& p : points) {
    if (!p.accepted()) continue;
    for (std::size_t i = 0; i < p.sightings.size(); ++i, count += 2)
      sum += (p.sightings[i].pixel - p.estimate->reprojected[i]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(count));
}

namespace {

Sighting sighting(const ImagePoint& p, const Rig& rig) {
  const int index = rig.find(p.camera);
  if (index < 0) {
    std::vector<std::string> names;
    for (const Camera& camera : rig.cameras) names.push_back(camera.name);
    bad_input(p.where, "the rig has no camera {}{}", in_quotes(p.camera), did_you_mean(p.camera, names));
  }
  const Camera& camera = rig.cameras[static_cast<std::size_t>(index)];
  const bool inside =
      p.u_px >= -0.5 && p.u_px <= camera.width_px - 0.5 && p.v_px >= -0.5 && p.v_px <= camera.height_px - 0.5;
  if (!inside)
    bad_input(p.where, "the pixel ({}, {}) lies outside the image of camera '{}', {}x{} pixels", p.u_px,
              p.v_px, camera.name, camera.width_px, camera.height_px);
  return {index, {p.u_px, p.v_px}, p.sigma_px};
}

// Views that are images: two or more, each of one camera that has no other. Their names in the rig's order,
// joined; empty where views are frames.
std::string frame_of_images(const std::vector<ImagePoint>& points, const Rig& rig) {
  std::map<std::string, std::string> camera_of_view, view_of_camera;
  for (const ImagePoint& p : points) {
    if (camera_of_view.emplace(p.view, p.camera).first->second != p.camera) return {};
    if (view_of_camera.emplace(p.camera, p.view).first->second != p.view) return {};
  }
  std::string out;
  if (view_of_camera.size() < 2) return out;
  for (const Camera& camera : rig.cameras) {
    if (const auto view = view_of_camera.find(camera.name); view != view_of_camera.end())
      out += (out.empty() ? "" : "+") + view->second;
  }
  return out;
}

std::vector<ReconstructedPoint> gather(const std::vector<ImagePoint>& points, const Rig& rig,
                                       const ReconstructOptions& options, const std::string& one_frame) {
  std::map<std::pair<OrganLabel, int>, ReconstructedPoint> gathered;
  for (const ImagePoint& p : points) {
    if (options.view && p.view != *options.view) continue;
    const std::string& view = one_frame.empty() ? p.view : one_frame;
    auto& out = gathered[{p.label, p.point}];
    if (out.sightings.empty()) {
      out.label = p.label;
      out.point = p.point;
      out.view = view;
      out.where = p.where;
    } else if (out.view != view) {
      // Between views the plant may have moved or been turned, so that their rays need not meet.
      bad_input(
          p.where,
          "{} stands in view {} and in view {}: a view is one frame of the whole rig, with the same name for "
          "all its cameras; choose one view of several",
          out.str(), in_quotes(out.view), in_quotes(p.view));
    }
    out.sightings.push_back(sighting(p, rig));
  }
  if (gathered.empty() && options.view) {
    std::vector<std::string> views;
    for (const ImagePoint& p : points) {
      if (std::find(views.begin(), views.end(), p.view) == views.end()) views.push_back(p.view);
    }
    bad_input({points.empty() ? "" : points.front().where.file}, "no point is of view {}{}",
              in_quotes(*options.view), did_you_mean(*options.view, views));
  }
  std::vector<ReconstructedPoint> out;
  for (auto& [key, point] : gathered) {
    // The result must not depend on the order of the rows.
    std::sort(point.sightings.begin(), point.sightings.end(),
              [](const Sighting& a, const Sighting& b) { return a.camera < b.camera; });
    out.push_back(std::move(point));
  }
  return out;
}

void solve(ReconstructedPoint& point, const Rig& rig, const RigErrors* errors, double gate_p) {
  const Triangulation found = triangulate(point.sightings, rig);
  point.reason = found.failure;
  if (!found.failure.empty()) return;
  PointEstimate& estimate = point.estimate.emplace();
  estimate.x_m = found.x_m;
  estimate.digitising_covariance_m2 = found.covariance_m2;
  estimate.rig_covariance_m2.setZero();
  for (const Projection& projection : found.projections) estimate.reprojected.push_back(projection.pixel);
  Eigen::MatrixXd by_rig, covariance;
  if (errors != nullptr && errors->size() > 0) {
    by_rig = errors->by_rig(point.sightings, found.projections);
    covariance = errors->covariance();
    // From J'(q - proj(X, b)) = 0: dX/db = -C J'G.
    estimate.by_rig = -found.covariance_m2 * found.by_point.transpose() * by_rig;
    const Eigen::Matrix3d part = estimate.by_rig * covariance * estimate.by_rig.transpose();
    estimate.rig_covariance_m2 = 0.5 * (part + part.transpose());
  }
  const GateResult result = gate(found.residual, found.by_point, by_rig, covariance);
  estimate.chi2 = result.chi2;
  estimate.dof = result.dof;
  estimate.p = result.p;
  if (result.p < gate_p) point.reason = "chi2";
}

}  // namespace

Vectors reconstruct(const std::vector<ImagePoint>& points, const Rig& rig,
                    const ReconstructOptions& options) {
  Vectors out;
  const std::string one_frame = options.view ? std::string() : frame_of_images(points, rig);
  if (!one_frame.empty())
    out.notes.push_back(
        fmt::format("each view is of one camera alone: taken for one frame, {}", in_quotes(one_frame)));
  out.points = gather(points, rig, options, one_frame);
  std::optional<RigErrors> errors;
  if (options.with_rig_covariance) errors.emplace(rig);
  parallel_for(out.points.size(), [&](std::size_t i) {
    throw_if_interrupted();
    solve(out.points[i], rig, errors ? &*errors : nullptr, options.gate_p);
  });
  return out;
}

}  // namespace bpms
