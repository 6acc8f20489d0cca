#include "reconstruct/points/frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/nearest.h"
#include "core/units.h"

namespace bpms {

VectorPoint Frame::operator()(VectorPoint p) const {
  p.x_m = point(p.x_m);
  p.covariance_m2 = covariance(p.covariance_m2);
  p.covariance_m2 = (0.5 * (p.covariance_m2 + p.covariance_m2.transpose())).eval();
  return p;
}

Eigen::Matrix3d upright(const Eigen::Vector3d& up) {
  const Eigen::Vector3d z = up.normalized();
  const double cos_10_degrees = std::cos(radians(10));
  const Eigen::Vector3d ahead =
      std::abs(z.x()) > cos_10_degrees ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d x = (ahead - ahead.dot(z) * z).normalized();
  Eigen::Matrix3d out;
  out << x.transpose(), z.cross(x).transpose(), z.transpose();
  return out;
}

Eigen::Vector3d image_up(const Rig& rig) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Camera& camera : rig.cameras) sum -= camera.r_cam_from_rig.row(1).transpose();
  return sum.normalized();
}

namespace {

const std::vector<std::string> keys{"plant", "axis", "rank", "organ", "feature", "point"};

std::string value_of(const ReconstructedPoint& p, const std::string& key) {
  if (key == "plant") return p.label.plant;
  if (key == "axis") return p.label.axis;
  if (key == "rank") return std::to_string(p.label.rank);
  if (key == "organ") return p.label.organ;
  if (key == "feature") return p.label.feature;
  return std::to_string(p.point);
}

std::vector<std::pair<std::string, std::string>> parse(const std::string& conditions) {
  std::vector<std::pair<std::string, std::string>> out;
  for (std::size_t at = 0; at <= conditions.size();) {
    const std::size_t end = std::min(conditions.find(',', at), conditions.size());
    const std::string part = conditions.substr(at, end - at);
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos)
      bad_input({}, "--origin: found {}, expected KEY=VALUE such as organ=bud", in_quotes(part));
    const std::string key = part.substr(0, equals);
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      bad_input({}, "--origin: unknown key {}{}", in_quotes(key), did_you_mean(key, keys));
    out.emplace_back(key, part.substr(equals + 1));
    at = end + 1;
  }
  return out;
}

}  // namespace

Eigen::Vector3d labelled_origin(const std::string& conditions, const Vectors& vectors) {
  const auto wanted = parse(conditions);
  const ReconstructedPoint* found = nullptr;
  const ReconstructedPoint* refused = nullptr;
  for (const ReconstructedPoint& p : vectors.points) {
    bool fits = true;
    for (const auto& [key, value] : wanted) fits = fits && value_of(p, key) == value;
    if (!fits) continue;
    if (!p.accepted()) {
      refused = &p;
      continue;
    }
    if (found != nullptr)
      bad_input({}, "--origin {}: fits {} and {}; say more of its label", conditions, found->str(), p.str());
    found = &p;
  }
  if (found != nullptr) return found->estimate->x_m;
  if (refused != nullptr)
    bad_input(refused->where, "--origin {}: {} was refused: {}", conditions, refused->str(), refused->reason);
  bad_input({}, "--origin {}: no point fits", conditions);
}

}  // namespace bpms
