#include "calibrate/targets/target.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "calibrate/targets/kalibr_board.h"
#include "calibrate/targets/target_kind.h"
#include "core/nearest.h"
#include "core/text.h"
#include "core/toml.h"

namespace bpms {
namespace {

// A measured point lies near the designed one, or the file belongs to another board.
constexpr double largest_offset_of_size = 0.1;

double extent(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d low = points.front(), high = low;
  for (const Eigen::Vector3d& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  return (high - low).norm();
}

void read_measured_points(const TomlValue& points, Target& target) {
  const std::vector<Eigen::Vector3d> designed = target.points_m();
  if (points.size() != designed.size())
    points.reject(fmt::format("has {} points, expected the {} of the board", points.size(), designed.size()));
  const double allowed = largest_offset_of_size * extent(designed);
  for (std::size_t i = 0; i < designed.size(); ++i) {
    const std::vector<double> x = points[i].numbers(3);
    const Eigen::Vector3d measured(x[0], x[1], x[2]);
    if ((measured - designed[i]).norm() > allowed)
      points[i].reject(
          fmt::format("lies {:.3g} m from where the design has point {}, expected below {:.3g} m",
                      (measured - designed[i]).norm(), i, allowed));
    target.measured_m.push_back(measured);
  }
}

Target board_from(const TomlDocument& document) {
  const TomlValue root = document.root();
  Target target;
  target.kind = root.require("kind").one_of(target_kind_names());
  target.name = root.string_or("name", "");
  const TargetKind& kind = target_kind(target.kind);
  target.stands = root.boolean_or("stands", !kind.flat());
  kind.read(root, target);
  if (const std::string trouble = kind.nonsense(target); !trouble.empty()) root.reject(trouble);
  if (const TomlValue points = root.get("points_m"); points && kind.flat())
    read_measured_points(points, target);
  document.finish();
  return target;
}

bool is_yaml(const std::string& path) {
  return path.ends_with(".yaml") || path.ends_with(".yml");
}

}  // namespace

int Target::size() const {
  return static_cast<int>(target_kind(kind).designed_points_m(*this).size());
}

std::vector<Eigen::Vector3d> Target::points_m() const {
  return measured_m.empty() ? target_kind(kind).designed_points_m(*this) : measured_m;
}

std::vector<Eigen::Vector2d> Target::bending() const {
  const TargetKind& its = target_kind(kind);
  const std::vector<Eigen::Vector3d> points = its.designed_points_m(*this);
  std::vector<Eigen::Vector2d> out(points.size(), Eigen::Vector2d::Zero());
  if (!its.flat()) return out;
  Eigen::Array3d low = points.front(), high = low;
  for (const Eigen::Vector3d& x : points) low = low.min(x.array()), high = high.max(x.array());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Array2d x =
        2 * (points[i].array() - low).head<2>() / (high - low).head<2>() - 1;  // flat boards have two sides
    out[i] = 1 - x.square();
  }
  return out;
}

std::string Target::point_name(int point) const {
  return target_kind(kind).point_name(*this, point);
}

bool is_target_file(const std::string& text) {
  return text.ends_with(".toml") || is_yaml(text);
}

Target parse_target(const std::string& text) {
  if (is_target_file(text)) return read_board(text);
  const std::string word = text.substr(0, text.find(':'));
  std::vector<std::string> words;
  for (const std::string& name : target_kind_names()) {
    const TargetKind& kind = target_kind(name);
    if (kind.form().empty()) continue;
    words.push_back(name);
    if (name != word || word.size() == text.size()) continue;
    Target target;
    target.kind = name;
    SpecParts parts(text, kind.example());
    kind.parse(parts, target);
    if (!parts.empty()) parts.reject("has too many parts");
    if (const std::string trouble = kind.nonsense(target); !trouble.empty()) parts.reject(trouble);
    return target;
  }
  bad_input({}, "--target {}: expected {}, a board.toml or a control_frame.toml{}", in_quotes(text),
            fmt::join(target_forms(), ", "), did_you_mean(word, words));
}

std::vector<Target> parse_targets(const std::vector<std::string>& texts) {
  std::vector<Target> out;
  std::map<std::string, std::string> owner;  // of each look
  std::map<std::string, int> names;
  for (const std::string& text : texts) {
    out.push_back(parse_target(text));
    Target& target = out.back();
    for (const std::string& look : target_kind(target.kind).looks(target)) {
      const auto [first, fresh] = owner.emplace(look, text);
      if (!fresh)
        bad_input({}, "--target {} and {} could be taken for each other: both show {}",
                  in_quotes(first->second), in_quotes(text), look);
    }
    if (target.name.empty())
      target.name =
          text.find(':') != std::string::npos ? target.kind : std::filesystem::path(text).stem().string();
    const int count = ++names[target.name];
    if (count > 1) target.name += fmt::format(" {}", count);
  }
  return out;
}

Target parse_board(const std::string& path, std::string_view text) {
  return is_yaml(path) ? parse_yaml_board(path, text) : board_from(TomlDocument::parse(path, text));
}

Target read_board(const std::string& path) {
  return parse_board(path, read_text(path));
}

std::string board_toml(const Target& target) {
  const TargetKind& kind = target_kind(target.kind);
  std::string out = fmt::format("kind = {}\n", toml_string(target.kind));
  if (!target.name.empty()) out += fmt::format("name = {}\n", toml_string(target.name));
  if (target.stands != !kind.flat()) out += fmt::format("stands = {}\n", target.stands);
  out += kind.toml(target);
  if (target.measured_m.empty()) return out;
  out += "points_m = [  # measured; x along a row, y down\n";
  for (const Eigen::Vector3d& x : target.measured_m)
    out += fmt::format("  [{}, {}, {}],\n", toml_number(x.x()), toml_number(x.y()), toml_number(x.z()));
  return out + "]\n";
}

}  // namespace bpms
