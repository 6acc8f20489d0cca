#include "reconstruct/report.h"

#include <cmath>

#include "core/units.h"

namespace bpms {
namespace {

Json numbers(const Eigen::VectorXd& values) {
  return std::vector<double>(values.begin(), values.end());
}

Json label_json(const OrganLabel& label) {
  return {{"plant", label.plant},
          {"axis", label.axis},
          {"rank", label.rank},
          {"organ", label.organ},
          {"feature", label.feature}};
}

Json point_json(const ReconstructedPoint& p, const Rig& rig, const Frame& frame) {
  Json out{{"point", p.point}};
  const auto sigma = [&](const Eigen::Matrix3d& c) {
    return numbers(frame.covariance(c).diagonal().cwiseMax(0).cwiseSqrt());
  };
  if (p.estimate) {
    const Eigen::Vector3d x = frame.point(p.estimate->x_m);
    out.update({{"x_m", x.x()}, {"y_m", x.y()}, {"z_m", x.z()}});
    out["sigma_m"] = sigma(p.estimate->covariance_m2());
    out["sigma_digitising_m"] = sigma(p.estimate->digitising_covariance_m2);
    out["sigma_rig_m"] = sigma(p.estimate->rig_covariance_m2);
    out["chi2"] = p.estimate->chi2;
    out["dof"] = p.estimate->dof;
    out["p"] = p.estimate->p;
  } else {
    for (const char* key : {"x_m", "y_m", "z_m", "sigma_m", "chi2"}) out[key] = nullptr;
  }
  out["rejected"] = !p.accepted();
  if (!p.accepted()) out["reason"] = p.reason;
  Json digitised = Json::object(), reprojected = Json::object();
  for (std::size_t i = 0; i < p.sightings.size(); ++i) {
    const std::string& camera = rig.cameras[static_cast<std::size_t>(p.sightings[i].camera)].name;
    digitised[camera] = numbers(p.sightings[i].pixel);
    if (p.estimate) reprojected[camera] = numbers(p.estimate->reprojected[i]);
  }
  out["digitised"] = digitised;
  out["reprojected"] = reprojected;
  return out;
}

}  // namespace

Json rejected_json(const Vectors& vectors) {
  Json out = Json::array();
  for (const ReconstructedPoint& p : vectors.points) {
    if (p.accepted()) continue;
    Json row = label_json(p.label);
    row["point"] = p.point;
    row["reason"] = p.reason;
    row["chi2"] = p.estimate ? Json(p.estimate->chi2) : Json();
    row["where"] = p.where.str();
    out.push_back(row);
  }
  return out;
}

Json reconstruction_json(const Vectors& vectors, const Rig& rig, const Frame& frame) {
  Json curves = Json::array();
  const OrganLabel* last = nullptr;
  for (const ReconstructedPoint& p : vectors.points) {
    if (last == nullptr || *last != p.label) {
      curves.push_back(label_json(p.label));
      curves.back()["points"] = Json::array();
      last = &p.label;
    }
    curves.back()["points"].push_back(point_json(p, rig, frame));
  }
  return {{"points", vectors.points.size() - vectors.refused()},
          {"points_total", vectors.points.size()},
          {"rejected", rejected_json(vectors)},
          {"reprojection_rms_px", vectors.reprojection_rms_px()},
          {"curves", curves}};
}

Json check_json(const DisparityCheck& check) {
  Json points = Json::array();
  for (const auto& p : check.points)
    points.push_back({{"label", p.label},
                      {"dz_m", p.dz_m},
                      {"sigma_m", p.sigma_m},
                      {"ratio", p.ratio},
                      {"rejected", p.rejected}});
  return {{"name", "depth against the disparity map"},
          {"median_ratio", check.median_ratio},
          {"median_abs_dz_m", check.median_abs_dz_m},
          {"unknown", check.unknown},
          {"points", points}};
}

Json rim_figures(const Rim& rim) {
  Json out = Json::array();
  out.push_back({{"name", "pot rim diameter"},
                 {"value", rim.diameter_m},
                 {"sigma", rim.diameter_sigma_m},
                 {"unit", "m"},
                 {"note", fmt::format("circle through {} points, {:.2g} mm rms off it beyond their errors",
                                      rim.points, 1e3 * rim.roughness_m)}});
  const double plane_sigma = rim.plane_rms_m / std::sqrt(2.0 * rim.points);
  out.push_back({{"name", "pot rim plane rms"},
                 {"value", rim.plane_rms_m},
                 {"sigma", plane_sigma},
                 {"unit", "m"},
                 {"note", "distance of the rim points from the plane of the circle"}});
  out.push_back(
      {{"name", "tilt of the pot rim"},
       {"value", degrees(rim.tilt_rad)},
       {"sigma", degrees(rim.normal_sigma_rad)},
       {"unit", "deg"},
       {"note",
        fmt::format("between its normal, ({:.4f}, {:.4f}, {:.4f}) in the rig's frame, and the images' up",
                    rim.normal.x(), rim.normal.y(), rim.normal.z())}});
  return out;
}

}  // namespace bpms
