#include "apps/bpms/calibrate_report.h"

#include <cmath>

#include "core/units.h"
#include "reconstruct/points/pair_uncertainty.h"

namespace bpms {
namespace {

Json vector_json(const Eigen::Vector3d& v) {
  return {json_number(v.x()), json_number(v.y()), json_number(v.z())};
}

// The rows of [R | t].
Json pose_json(const Pose& pose) {
  Json out = Json::array();
  for (Eigen::Index row = 0; row < 3; ++row)
    out.push_back({json_number(pose.r(row, 0)), json_number(pose.r(row, 1)), json_number(pose.r(row, 2)),
                   json_number(pose.t_m[row])});
  return out;
}

// `px` row by row; null where the lens has no ray.
Json map_json(const ProjectionMap& map) {
  Json px = Json::array();
  for (const double v : map.px) px.push_back(std::isfinite(v) ? json_number(v) : Json(nullptr));
  return {{"range_m", json_number(map.range_m)},
          {"x_px", map.x_px},
          {"y_px", map.y_px},
          {"px", px},
          {"median_px", json_number(map.quantile(0.5))},
          {"p90_px", json_number(map.quantile(0.9))},
          {"max_px", json_number(map.quantile(1))}};
}

Json target_json(const Target& target) {
  return {{"kind", target.kind},
          {"columns", target.columns},
          {"rows", target.rows},
          {"square_m", target.square_m}};
}

Json target_result_json(const Target& target, const Calibration::TargetResult& result) {
  Json out = target_json(target);
  out["name"] = result.name;
  out["stands"] = result.stands;
  out["views"] = result.views;
  out["warp_m"] = {json_number(result.warp_m.x()), json_number(result.warp_m.y())};
  Json points = Json::array(), nominal = Json::array(), bars = Json::array();
  for (const Eigen::Vector3d& x : result.points_m) points.push_back(vector_json(x));
  for (const Eigen::Vector3d& x : target.points_m()) nominal.push_back(vector_json(x));
  for (const auto& bar : result.bars)
    bars.push_back({{"a", bar.bar.a},
                    {"b", bar.bar.b},
                    {"length_m", bar.bar.length_m},
                    {"sigma_m", bar.bar.sigma_m},
                    {"found_m", json_number(bar.found_m)}});
  out["nominal_points_m"] = nominal;
  out["points_m"] = points;
  out["scale_bars"] = bars;
  return out;
}

// Poses of the rig (where it moves) and of the targets, in the order of `frames`.
Json poses_json(const Calibration& c) {
  Json rig = Json::array(), targets = Json::array();
  for (const Pose& pose : c.poses.rig_from_world) rig.push_back(pose_json(pose));
  for (const auto& slots : c.poses.world_from_target) {
    targets.push_back(Json::array());
    for (const Pose& pose : slots) targets.back().push_back(pose_json(pose));
  }
  return {{"frames", c.poses.frames}, {"rig_from_world", rig}, {"world_from_target", targets}};
}

Json camera_json(const Calibration& c, std::size_t index) {
  const Camera& camera = c.rig.cameras[index];
  const auto& order = c.rig.covariance->order;
  Json sigma = Json::object(), clustered = Json::object();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::string prefix = camera.name + ".";
    if (!order[i].starts_with(prefix)) continue;
    const auto k = static_cast<Eigen::Index>(i);
    sigma[order[i].substr(prefix.size())] = json_number(c.sigma_iid[k]);
    clustered[order[i].substr(prefix.size())] =
        c.sigma_clustered.size() > 0 ? json_number(c.sigma_clustered[k]) : Json(nullptr);
  }
  const std::vector<double>& p = camera.parameters;
  std::vector<std::string> lens_names = parameter_names(camera);  // the pose's names come last
  lens_names.resize(p.size());
  return {{"name", camera.name},
          {"model", camera.model},
          {"width", camera.width_px},
          {"height", camera.height_px},
          {"fx", json_number(p[0])},
          {"fy", json_number(p[1])},
          {"cx", json_number(p[2])},
          {"cy", json_number(p[3])},
          {"parameter_names", lens_names},
          {"distortion", std::vector<double>(p.begin() + 4, p.end())},
          {"sigma", sigma},
          {"projection_sigma", index < c.projection.size() ? map_json(c.projection[index]) : Json(nullptr)},
          {"cam_from_rig", pose_json({camera.r_cam_from_rig, camera.t_cam_from_rig_m})},
          {"sigma_clustered", clustered}};
}

Json pair_json(const Calibration& c, const Calibration::Pair& pair) {
  return {{"a", c.rig.cameras[static_cast<std::size_t>(pair.a)].name},
          {"b", c.rig.cameras[static_cast<std::size_t>(pair.b)].name},
          {"baseline_m", json_number(pair.baseline_m)},
          {"baseline_sigma_m", json_number(pair.baseline_sigma_m)},
          {"baseline_sigma_clustered_m",
           pair.baseline_sigma_clustered_m ? json_number(*pair.baseline_sigma_clustered_m) : Json(nullptr)},
          {"rotation_deg", vector_json(pair.rotation_vector * degrees(1.0))},
          {"translation_m", vector_json(pair.translation_m)}};
}

Json view_json(const Calibration::View& view) {
  Json residuals = Json::array();
  for (const Eigen::Vector4d& r : view.residuals) residuals.push_back({r[0], r[1], r[2], r[3]});
  return {{"image", view.image},
          {"camera", view.camera},
          {"frame", view.frame},
          {"target", view.target},
          {"rms_px", json_number(view.rms_px)},
          {"outlier", view.outlier},
          {"reason", view.reason},
          {"residuals", residuals},
          {"points", view.points}};
}

// Row by row. Of a rig of many parameters it is left to rig.toml: a picture of it tells nothing any more.
Json covariance_json(const Rig::Covariance& covariance) {
  constexpr std::size_t most = 300;
  if (covariance.order.size() > most) return nullptr;
  Json rows = Json::array();
  for (const auto row : covariance.matrix.rowwise()) {
    rows.push_back(Json::array());
    for (const double v : row) rows.back().push_back(json_number(v));
  }
  return {{"kind", covariance.kind}, {"order", covariance.order}, {"matrix", rows}};
}

// How sure each pair that has a baseline places a point, around the distance at which the corners were.
Json triangulation_json(const Calibration& c) {
  Json out = Json::array();
  for (const auto& pair : c.pairs) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    if (!(pair.baseline_m > 0) || std::max(a, b) >= c.projection.size()) continue;
    const double usual_m = 0.5 * (c.projection[a].range_m + c.projection[b].range_m);
    if (!(usual_m > 0) || !(c.residual_sigma_px > 0)) continue;
    std::vector<double> ranges_m;
    for (const double times : {0.5, 0.7, 1.0, 1.4, 2.0}) ranges_m.push_back(times * usual_m);
    for (const PairUncertainty& at : pair_uncertainty(c.rig, pair.a, pair.b, c.residual_sigma_px, ranges_m))
      out.push_back({{"a", c.rig.cameras[a].name},
                     {"b", c.rig.cameras[b].name},
                     {"range_m", json_number(at.range_m)},
                     {"sigma_x_m", json_number(at.sigma_m.x())},
                     {"sigma_y_m", json_number(at.sigma_m.y())},
                     {"sigma_z_m", json_number(at.sigma_m.z())},
                     {"observation_sigma_x_m", json_number(at.observation_sigma_m.x())},
                     {"observation_sigma_y_m", json_number(at.observation_sigma_m.y())},
                     {"observation_sigma_z_m", json_number(at.observation_sigma_m.z())}});
  }
  return out;
}

// In the frame of the first camera.
Json turntable_json(const Calibration::Turntable& table) {
  const auto known = [](const std::optional<double>& v) { return v ? json_number(*v) : Json(nullptr); };
  return {{"direction", vector_json(table.direction)},
          {"point_m", vector_json(table.point_m)},
          {"direction_sigma_rad", json_number(table.direction_sigma_rad)},
          {"direction_sigma_clustered_rad", json_number(table.direction_sigma_clustered_rad)},
          {"point_sigma_m", json_number(table.point_sigma_m)},
          {"point_sigma_clustered_m", json_number(table.point_sigma_clustered_m)},
          {"halves_angle_rad", known(table.halves_angle_rad)},
          {"halves_distance_m", known(table.halves_distance_m)}};
}

}  // namespace

Json calibration_json(const Calibration& c, const Observations& observations,
                      const std::vector<Target>& targets, const std::string& model) {
  Json out{{"model", model},
           {"target", target_json(targets.front())},
           {"targets", Json::array()},
           {"cameras", Json::array()},
           {"pairs", Json::array()},
           {"residual_rms_px", json_number(c.residual_rms_px)},
           {"residual_sigma_px", json_number(c.residual_sigma_px)},
           {"degrees_of_freedom", c.degrees_of_freedom},
           {"frames", c.frames},
           {"corners_used", c.corners_used},
           {"corners_total", c.corners_total},
           {"views", Json::array()},
           {"skipped", Json::array()},
           {"outliers", Json::array()},
           {"board_warp_m", {json_number(c.targets[0].warp_m.x()), json_number(c.targets[0].warp_m.y())}},
           {"covariance_kind", c.rig.covariance->kind},
           {"converged", c.converged}};
  for (std::size_t i = 0; i < c.rig.cameras.size(); ++i) out["cameras"].push_back(camera_json(c, i));
  for (std::size_t t = 0; t < targets.size(); ++t)
    out["targets"].push_back(target_result_json(targets[t], c.targets[t]));
  out["poses"] = poses_json(c);
  out["covariance"] = covariance_json(*c.rig.covariance);
  out["triangulation"] = triangulation_json(c);
  for (const auto& pair : c.pairs) out["pairs"].push_back(pair_json(c, pair));
  for (const auto& view : c.views) out["views"].push_back(view_json(view));
  for (const auto& [image, reason] : observations.skipped)
    out["skipped"].push_back({{"image", image}, {"reason", reason}});
  for (const auto& o : c.outliers)
    out["outliers"].push_back(
        {{"image", o.image}, {"corner", o.corner}, {"residual_px", json_number(o.residual_px)}});
  if (c.half_sets)
    out["half_sets"] = {
        {"odd_baseline_m", json_number(c.half_sets->odd_baseline_m)},
        {"even_baseline_m", json_number(c.half_sets->even_baseline_m)},
        {"difference_m", json_number(c.half_sets->odd_baseline_m - c.half_sets->even_baseline_m)},
        {"sigma_clustered_m", json_number(c.half_sets->sigma_clustered_m)},
        {"difference", Json::array()}};
  if (c.half_sets)
    for (const ProjectionMap& map : c.half_sets->difference)
      out["half_sets"]["difference"].push_back(map_json(map));
  if (c.turntable) out["turntable"] = turntable_json(*c.turntable);
  out["seconds"] = {{"solve", c.solve_seconds}, {"uncertainty", c.uncertainty_seconds}};
  return out;
}

Json lens_selection_json(const LensSelection& selection) {
  Json out = Json::array();
  for (const LensScore& score : selection.scores) {
    const bool judged = score.refused.empty();
    const auto number = [judged](double value) { return judged ? json_number(value) : Json(nullptr); };
    out.push_back({{"choice", score.lens},
                   {"parameters", score.parameters},
                   {"rms_px", number(score.in_sample_rms_px)},
                   {"cross_validated_px", number(score.predicted_rms_px)},
                   {"se_px", number(score.predicted_se_px)},
                   {"worse_px2", number(score.worse_px2)},
                   {"worse_se_px2", number(score.worse_se_px2)},
                   {"chosen", score.chosen},
                   {"refused", judged ? Json(nullptr) : Json(score.refused)}});
  }
  return out;
}

}  // namespace bpms
