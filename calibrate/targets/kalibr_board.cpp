#include "calibrate/targets/kalibr_board.h"

#include <Eigen/Geometry>
#include <set>

#include "calibrate/targets/tag_detector.h"
#include "calibrate/targets/target_kind.h"
#include "calibrate/yaml.h"
#include "core/nearest.h"

namespace bpms {
namespace {

constexpr double largest_m = 100;

double length_of(const YamlValue& value) {
  const double out = value.number();
  if (!(out > 0) || out > largest_m) value.reject("expected a length in metres, above 0 and at most 100");
  return out;
}

int count_of(const YamlValue& value) {
  constexpr int fewest = 3, most = 200;
  return static_cast<int>(value.integer(fewest, most));
}

// Squares of another width than height are told by measured points.
Target kalibr_checkerboard(const YamlValue& root) {
  Target out;
  out.columns = count_of(root.require("targetCols"));
  out.rows = count_of(root.require("targetRows"));
  const double across = length_of(root.require("colSpacingMeters")),
               down = length_of(root.require("rowSpacingMeters"));
  out.square_m = across;
  constexpr double rounding = 1e-9;
  if (std::abs(across - down) < rounding * across) return out;
  out.measured_m = out.points_m();
  for (Eigen::Vector3d& x : out.measured_m) x.y() *= down / across;
  return out;
}

Target kalibr_circlegrid(const YamlValue& root) {
  Target out;
  const YamlValue asymmetric = root.get("asymmetricGrid");
  const std::string word = asymmetric ? asymmetric.string() : "";
  const bool shifted = word == "1" || word == "True" || word == "true";
  out.kind = shifted ? "asymmetric_circles" : "circles";
  out.columns = count_of(root.require("targetCols"));
  out.rows = count_of(root.require("targetRows"));
  out.square_m = length_of(root.require("spacingMeters"));
  // Kalibr does not say how wide the circles are; only the correction for perspective needs it.
  constexpr double usual_of_pitch = 0.5;
  out.mark_m = usual_of_pitch * out.square_m;
  if (const YamlValue diameter = root.get("diameterMeters")) out.mark_m = length_of(diameter);
  if (const std::string trouble = target_kind(out.kind).nonsense(out); !trouble.empty()) root.reject(trouble);
  return out;
}

// There y of a tag points up and z out of it; here y points down and z into the surface.
TargetTag ros_tag(const YamlValue& entry) {
  TargetTag out;
  out.id = static_cast<int>(entry.require("id").integer(0, tag_codes - 1));
  out.size_m = length_of(entry.require("size"));
  const auto number_or = [&](const char* key, double otherwise) {
    const YamlValue value = entry.get(key);
    return value ? value.number() : otherwise;
  };
  out.centre_m = {number_or("x", 0), number_or("y", 0), number_or("z", 0)};
  const Eigen::Quaterniond q(number_or("qw", 1), number_or("qx", 0), number_or("qy", 0), number_or("qz", 0));
  constexpr double least_norm = 1e-6;
  if (!(q.norm() > least_norm) || !(out.centre_m.cwiseAbs().maxCoeff() < 1e5))
    entry.reject("expected a quaternion that is not zero and a place within 100 km");
  const Eigen::Vector3d turned(1, -1, -1);
  out.r_target_from_tag = q.normalized().toRotationMatrix() * turned.asDiagonal();
  return out;
}

Target ros_bundle(const YamlValue& bundles) {
  if (!bundles.is_list() || bundles.size() != 1)
    bundles.reject(fmt::format("has {} bundles, expected one", bundles.is_list() ? bundles.size() : 0));
  const YamlValue bundle = bundles[0];
  Target out;
  out.kind = "control_frame";
  out.stands = true;
  if (const YamlValue name = bundle.get("name")) out.name = name.string();
  std::set<int> ids;
  const YamlValue layout = bundle.require("layout");
  if (!layout.is_list()) layout.reject("expected a list of tags");
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const YamlValue entry = layout[i];
    out.tags.push_back(ros_tag(entry));
    if (!ids.insert(out.tags.back().id).second)
      entry.reject(fmt::format("tag {} is there twice", out.tags.back().id));
  }
  if (out.tags.empty()) layout.reject("has no tags");
  return out;
}

}  // namespace

Target parse_yaml_board(const std::string& path, std::string_view text) {
  const YamlValue root = YamlValue::parse(path, std::string(text));
  if (const YamlValue bundles = root.get("tag_bundles")) return ros_bundle(bundles);
  const YamlValue type = root.get("target_type");
  if (!type)
    root.reject(
        "neither target_type of a Kalibr board nor tag_bundles; expected a checkerboard, a circlegrid "
        "or tags of apriltag_ros");
  const std::string word = type.string();
  if (word == "aprilgrid")
    type.reject(
        "Kalibr's boards of tags cannot be read by AprilTag 3, their black squares break the white "
        "border of the tags; print one of bpms: bpms target apriltag:6x6:40mm:10mm -o board.pdf");
  if (word == "checkerboard") return kalibr_checkerboard(root);
  if (word == "circlegrid") return kalibr_circlegrid(root);
  type.reject(fmt::format("no target_type {}{}", in_quotes(word),
                          did_you_mean(word, {"checkerboard", "circlegrid"})));
}

}  // namespace bpms
