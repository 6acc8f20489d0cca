#include "calibrate/targets/kalibr_board.h"

#include <Eigen/Geometry>
#include <set>

#include "calibrate/targets/small_yaml.h"
#include "calibrate/targets/tag_detector.h"
#include "calibrate/targets/target_kind.h"
#include "core/nearest.h"

namespace bpms {
namespace {

constexpr double largest_m = 100;

double length_of(const SmallYaml& value) {
  const double out = value.number();
  if (!(out > 0) || out > largest_m) value.reject("expected a length in metres, above 0 and at most 100");
  return out;
}

int count_of(const SmallYaml& value) {
  constexpr int fewest = 3, most = 200;
  return static_cast<int>(value.integer(fewest, most));
}

// Squares of another width than height are told by measured points.
Target kalibr_checkerboard(const SmallYaml& root) {
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

Target kalibr_circlegrid(const SmallYaml& root) {
  Target out;
  const SmallYaml* asymmetric = root.find("asymmetricGrid");
  const bool shifted =
      asymmetric && (asymmetric->word == "1" || asymmetric->word == "True" || asymmetric->word == "true");
  out.kind = shifted ? "asymmetric_circles" : "circles";
  out.columns = count_of(root.require("targetCols"));
  out.rows = count_of(root.require("targetRows"));
  out.square_m = length_of(root.require("spacingMeters"));
  // Kalibr does not say how wide the circles are; only the correction for perspective needs it.
  constexpr double usual_of_pitch = 0.5;
  out.mark_m = usual_of_pitch * out.square_m;
  if (const SmallYaml* diameter = root.find("diameterMeters")) out.mark_m = length_of(*diameter);
  if (const std::string trouble = target_kind(out.kind).nonsense(out); !trouble.empty()) root.reject(trouble);
  return out;
}

// There y of a tag points up and z out of it; here y points down and z into the surface.
TargetTag ros_tag(const SmallYaml& entry) {
  TargetTag out;
  out.id = static_cast<int>(entry.require("id").integer(0, tag_codes - 1));
  out.size_m = length_of(entry.require("size"));
  const auto number_or = [&](const char* key, double otherwise) {
    const SmallYaml* value = entry.find(key);
    return value ? value->number() : otherwise;
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

Target ros_bundle(const SmallYaml& bundles) {
  if (bundles.kind != SmallYaml::Kind::list || bundles.items.size() != 1)
    bundles.reject(fmt::format("has {} bundles, expected one", bundles.items.size()));
  const SmallYaml& bundle = bundles.items.front();
  Target out;
  out.kind = "control_frame";
  out.stands = true;
  if (bundle.kind == SmallYaml::Kind::map && bundle.find("name")) out.name = bundle.find("name")->word;
  std::set<int> ids;
  const SmallYaml& layout = bundle.require("layout");
  if (layout.kind != SmallYaml::Kind::list) layout.reject("expected a list of tags");
  for (const SmallYaml& entry : layout.items) {
    out.tags.push_back(ros_tag(entry));
    if (!ids.insert(out.tags.back().id).second)
      entry.reject(fmt::format("tag {} is there twice", out.tags.back().id));
  }
  if (out.tags.empty()) layout.reject("has no tags");
  return out;
}

}  // namespace

Target parse_yaml_board(const std::string& path, std::string_view text) {
  const SmallYaml root = SmallYaml::parse(path, text);
  if (const SmallYaml* bundles = root.find("tag_bundles")) return ros_bundle(*bundles);
  const SmallYaml* type = root.find("target_type");
  if (!type)
    root.reject(
        "neither target_type of a Kalibr board nor tag_bundles; expected a checkerboard, a circlegrid "
        "or tags of apriltag_ros");
  if (type->word == "aprilgrid")
    type->reject(
        "Kalibr's boards of tags cannot be read by AprilTag 3, their black squares break the white "
        "border of the tags; print one of bpms: bpms target apriltag:6x6:40mm:10mm -o board.pdf");
  if (type->word == "checkerboard") return kalibr_checkerboard(root);
  if (type->word == "circlegrid") return kalibr_circlegrid(root);
  type->reject(fmt::format("no target_type {}{}", in_quotes(type->word),
                           did_you_mean(type->word, {"checkerboard", "circlegrid"})));
}

}  // namespace bpms
