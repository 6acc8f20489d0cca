// OPS: a line `T x y z width depth flat` for the plot, then a row for each plant; a line #[Archimed] NAME
// names the functional group of those that come after it. Metres and radians.
#include <algorithm>

#include "core/text.h"
#include "plant/opf.h"

namespace bpms {
namespace {

constexpr double farthest_ops_m = 1e7;
constexpr double most_turn = 1e4;  // radians: larger ones are another unit or a mistake

std::vector<Token> ops_tokens(std::string_view line, int number) {
  std::vector<Token> out;
  for (std::size_t at = 0;;) {
    at = line.find_first_not_of(" \t\r", at);
    if (at == std::string_view::npos) return out;
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    out.push_back({line.substr(at, end - at), number, static_cast<int>(at) + 1});
    at = end;
  }
}

class OpsReader {
 public:
  OpsReader(const std::string& path, std::string_view text) : path_(path), rest_(text) {}

  OpsScene read() {
    for (int number = 1; !rest_.empty(); ++number) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      const std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      read_line(ops_tokens(line, number));
    }
    if (out_.rows.empty()) bad_input({path_}, "no plants, expected rows {}", columns);
    return std::move(out_);
  }

 private:
  static constexpr const char* columns =
      "sceneId plantId file x y z scale inclinationAzimut inclinationAngle stemTwist";

  SourceLocation where(const Token& token) const { return {path_, token.line, token.column}; }
  double number(const Token& token, const char* what, double most) const {
    const auto value = parse_number(token.text);
    if (!value || !(std::abs(*value) <= most))
      bad_input(where(token), "found {}, expected {} (a number up to {:g})", in_quotes(token.text), what,
                most);
    return *value;
  }

  void read_line(const std::vector<Token>& tokens) {
    if (tokens.empty()) return;
    if (tokens[0].text.starts_with('#')) {
      if (tokens[0].text == "#[Archimed]") {
        group_.clear();
        for (std::size_t i = 1; i < tokens.size(); ++i)
          group_ += (i > 1 ? " " : "") + std::string(tokens[i].text);
      }
      return;
    }
    if (tokens[0].text == "T") return read_plot(tokens);
    if (tokens.size() == 3 && tokens[0].text == "-1") return;  // a chaining line: not about places
    if (tokens.size() != 10)
      bad_input(where(tokens[0]), "{} columns, expected 10 ({})", tokens.size(), columns);
    OpsRow row;
    row.group = group_;
    row.scene = whole(tokens[0], "sceneId");
    row.plant = whole(tokens[1], "plantId");
    row.file = tokens[2].text;
    const char* axes[] = {"x", "y", "z"};
    for (int k = 0; k < 3; ++k)
      row.position_m[k] = number(tokens[static_cast<std::size_t>(3 + k)], axes[k], farthest_ops_m);
    row.scale = number(tokens[6], "scale", 1e6);
    if (!(row.scale > 1e-9)) bad_input(where(tokens[6]), "scale {}, expected one above 0", row.scale);
    row.lean_azimuth = number(tokens[7], "inclinationAzimut in radians", most_turn);
    row.lean = number(tokens[8], "inclinationAngle in radians", most_turn);
    row.twist = number(tokens[9], "stemTwist in radians", most_turn);
    out_.rows.push_back(std::move(row));
  }

  long long whole(const Token& token, const char* what) const {
    const auto value = parse_integer(token.text);
    if (!value)
      bad_input(where(token), "found {}, expected {} (a whole number)", in_quotes(token.text), what);
    return *value;
  }

  void read_plot(const std::vector<Token>& tokens) {
    if (tokens.size() < 6)
      bad_input(where(tokens[0]), "{} columns, expected T xOrigin yOrigin zOrigin xSize ySize flat",
                tokens.size());
    for (int k = 0; k < 3; ++k)
      out_.origin_m[k] = number(tokens[static_cast<std::size_t>(1 + k)], "an origin", farthest_ops_m);
    for (int k = 0; k < 2; ++k) {
      out_.size_m[k] = number(tokens[static_cast<std::size_t>(4 + k)], "a size", farthest_ops_m);
      if (!(out_.size_m[k] > 0))
        bad_input(where(tokens[static_cast<std::size_t>(4 + k)]), "expected a size above 0");
    }
    if (tokens.size() > 6 && tokens[6].text != "flat")
      bad_input(where(tokens[6]), "terrain {} is not read, expected flat", in_quotes(tokens[6].text));
  }

  const std::string& path_;
  std::string_view rest_;
  std::string group_;
  OpsScene out_;
};

}  // namespace

Eigen::Affine3d OpsRow::world_from_plant() const {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  // The lean turns about the horizontal axis across its direction; the twist comes first.
  const Eigen::Quaterniond turn = AngleAxisd(lean_azimuth, Vector3d::UnitZ()) *
                                  AngleAxisd(lean, Vector3d::UnitY()) *
                                  AngleAxisd(twist - lean_azimuth, Vector3d::UnitZ());
  return Eigen::Translation3d(position_m) * turn * Eigen::Scaling(scale);
}

OpsScene parse_ops(const std::string& path, std::string_view text) {
  return OpsReader(path, text).read();
}

OpsScene read_ops(const std::string& path) {
  return parse_ops(path, read_text(path));
}

std::string ops_text(const OpsScene& scene) {
  std::string out = "# lengths in metres, angles in radians\n# T xOrigin yOrigin zOrigin xSize ySize flat\n";
  if (scene.size_m.minCoeff() > 0)
    out += fmt::format("T {} {} {} {} {} flat\n", scene.origin_m.x(), scene.origin_m.y(), scene.origin_m.z(),
                       scene.size_m.x(), scene.size_m.y());
  const std::string* group = nullptr;
  for (const OpsRow& row : scene.rows) {
    if (group == nullptr || *group != row.group) {
      group = &row.group;
      out += "#[Archimed] " + row.group +
             "\n#sceneId plantId plantFileName x y z scale inclinationAzimut inclinationAngle stemTwist\n";
    }
    if (row.file.empty() || row.file.find_first_of(" \t\r\n") != std::string::npos)
      bad_input({row.file}, "a name that OPS cannot hold: it has no way to write spaces");
    out += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", row.scene, row.plant, row.file,
                       row.position_m.x(), row.position_m.y(), row.position_m.z(), row.scale,
                       row.lean_azimuth, row.lean, row.twist);
  }
  return out;
}

}  // namespace bpms
