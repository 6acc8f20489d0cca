#include "fit/report.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "core/units.h"

namespace bpms {
namespace {

Json points(const std::vector<Eigen::Vector3d>& list) {
  Json out = Json::array();
  for (const Eigen::Vector3d& p : list)
    out.push_back({json_number(p.x()), json_number(p.y()), json_number(p.z())});
  return out;
}

Json function(const FittedFunction& f, bool angle) {
  const double unit = angle ? degrees(1) : 1.0;
  Json coefficients = Json::array(), sigma = Json::array(), l = Json::array(), value = Json::array(),
       band = Json::array();
  for (Eigen::Index k = 0; k < f.coefficients.size(); ++k) {
    coefficients.push_back(json_number(unit * f.coefficients[k]));
    sigma.push_back(json_number(unit * std::sqrt(f.covariance(k, k))));
  }
  constexpr int steps = 40;
  for (int k = 0; k <= steps; ++k) {
    const double at = static_cast<double>(k) / steps;
    l.push_back(at);
    value.push_back(json_number(unit * f.value(at)));
    band.push_back(json_number(unit * f.sigma(at)));
  }
  return {{"kind", std::string(1, f.choice.code)},
          {"order", f.choice.order},
          {"unit", angle ? "deg" : "m"},
          {"coefficients", coefficients},
          {"sigma", sigma},
          {"aicc", json_number(f.aicc)},
          {"curve", {{"l", l}, {"value", value}, {"sigma", band}}}};
}

Json aicc_table(const OrganFit& fit) {
  Json out = Json::array();
  for (const auto& [name, rows] : fit.aicc_table) {
    for (const auto& [choice, aicc] : rows)
      out.push_back({{"function", name},
                     {"kind", std::string(1, choice.code)},
                     {"order", choice.order},
                     {"aicc", json_number(aicc)}});
  }
  return out;
}

// Angles of the polyline's pieces in the leaf's frame: what the integrated functions stand beside, not what
// was fitted.
Json measured(const OrganFit& fit) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(fit.direction, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  double length = 0;
  for (std::size_t k = 1; k < fit.points_m.size(); ++k)
    length += (fit.points_m[k] - fit.points_m[k - 1]).norm();
  Json l = Json::array(), inclination = Json::array(), azimuth = Json::array();
  double arc = 0, before = 0;
  for (std::size_t k = 1; k < fit.points_m.size(); ++k) {
    const Eigen::Vector3d step = turn.transpose() * (fit.points_m[k] - fit.points_m[k - 1]);
    const double piece = step.norm();
    if (piece <= 0) continue;
    double angle = std::atan2(step.x(), step.z());
    angle -= 2 * pi * std::round((angle - before) / (2 * pi));
    before = angle;
    l.push_back((arc + piece / 2) / length);
    inclination.push_back(degrees(angle));
    azimuth.push_back(degrees(std::asin(std::clamp(-step.y() / piece, -1.0, 1.0))));
    arc += piece;
  }
  Json out{{"l", l}, {"inclination", inclination}};
  if (fit.functions.contains("azimuth")) out["azimuth"] = azimuth;
  return out;
}

Json organ(const OrganFit& fit) {
  Json out{{"id", nullptr},
           {"plant", fit.measured.plant},
           {"axis", fit.measured.axis},
           {"rank", fit.measured.rank},
           {"organ", fit.measured.organ},
           {"key", fit.measured.key},
           {"points", fit.measured.midrib.size()}};
  if (!fit.ok()) {
    for (const char* key : {"length_m", "length_sigma_m", "rms_m", "rms_fraction", "chi2_per_dof"})
      out[key] = nullptr;
    out["functions"] = Json::object();
    out["failure"] = fit.failure;
    out["points_m"] = points(fit.points_m);
    return out;
  }
  out["length_m"] = json_number(fit.length_m);
  out["length_sigma_m"] = json_number(fit.length_sigma_m);
  out["rms_m"] = json_number(fit.rms_m);
  out["rms_fraction"] = json_number(fit.rms_m / fit.length_m);
  out["chi2_per_dof"] = fit.chi2_per_dof ? json_number(*fit.chi2_per_dof) : Json(nullptr);
  out["edge_chi2_per_dof"] = fit.edge_chi2_per_dof ? json_number(*fit.edge_chi2_per_dof) : Json(nullptr);
  out["degrees_of_freedom"] = fit.degrees_of_freedom;
  out["point_sigma_m"] = fit.errors_known ? Json(nullptr) : json_number(fit.sigma_m);
  out["direction_deg"] = json_number(degrees(fit.direction));
  out["direction_sigma_deg"] = json_number(degrees(fit.direction_sigma));
  out["base_m"] = {json_number(fit.base_m.x()), json_number(fit.base_m.y()), json_number(fit.base_m.z())};
  out["base_sigma_m"] = {json_number(std::sqrt(fit.base_covariance_m2(0, 0))),
                         json_number(std::sqrt(fit.base_covariance_m2(1, 1))),
                         json_number(std::sqrt(fit.base_covariance_m2(2, 2)))};
  out["width_m"] = json_number(fit.width_m);
  out["width_sigma_m"] = json_number(fit.width_sigma_m);
  out["edges_swapped"] = fit.edges_swapped;
  out["outliers"] = fit.outliers;
  out["notes"] = fit.notes;
  Json functions = Json::object();
  for (const auto& [name, f] : fit.functions) functions[name] = function(f, name != "width");
  out["functions"] = functions;
  out["aicc_table"] = aicc_table(fit);
  out["measured"] = measured(fit);
  out["points_m"] = points(fit.points_m);
  out["fitted_m"] = points(fit.fitted_m);
  return out;
}

}  // namespace

Json fit_summary(const std::vector<OrganFit>& fits) {
  std::vector<double> fractions;
  for (const OrganFit& fit : fits)
    if (fit.ok()) fractions.push_back(fit.rms_m / fit.length_m);
  return {{"organs", fits.size()},
          {"rms_fraction_median", json_number(quantile(fractions, 0.5))},
          {"rms_fraction_p90", json_number(quantile(fractions, 0.9))},
          {"failed", fits.size() - fractions.size()}};
}

Json fit_report(const std::vector<OrganFit>& fits, const std::vector<FittedPlant>& plants) {
  Json organs = Json::array(), plant_list = Json::array();
  for (const OrganFit& fit : fits) organs.push_back(organ(fit));
  for (const FittedPlant& plant : plants) {
    plant_list.push_back({{"name", plant.plant.name},
                          {"organs", plant.organs.size()},
                          {"origin_m", {plant.origin_m.x(), plant.origin_m.y(), plant.origin_m.z()}}});
    for (std::size_t k = 0; k < plant.organs.size(); ++k) {
      Json& entry = organs[plant.organs[k]];
      entry["id"] = plant.ids[k];
      const Eigen::Vector3d offset = fits[plant.organs[k]].base_m - plant.origin_m;
      entry["base_offset_m"] = {offset.x(), offset.y(), offset.z()};
    }
  }
  return {{"organs", organs}, {"plants", plant_list}, {"summary", fit_summary(fits)}};
}

}  // namespace bpms
