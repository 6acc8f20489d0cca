#include "scene/importers/shape_list.h"

#include <algorithm>
#include <cmath>

#include "core/nearest.h"
#include "core/text.h"
#include "core/units.h"

namespace bpms {
namespace {

// Metres: float coordinates beyond the one mean nothing to a leaf, the other is not far from zero in floats.
constexpr double largest_coordinate_m = 1e7, smallest_size_m = 1e-9;

struct ShapeWord {
  const char* name;
  const char* columns;
};
constexpr ShapeWord shape_words[] = {{"sphere", "x y z r"},
                                     {"ellipsoid", "x y z rx ry rz [rz_deg ry_deg rx_deg]"},
                                     {"spheroid", "x y z r_across r_along [ax ay az]"},
                                     {"cylinder", "x0 y0 z0 x1 y1 z1 r [open | closed]"},
                                     {"cone", "x0 y0 z0 x1 y1 z1 r0 r1 [open | closed]"}};

// One line, taken apart from the left.
class ShapeLine {
 public:
  ShapeLine(const std::string& file, std::vector<Token> tokens) : file_(file), tokens_(std::move(tokens)) {}

  SourceLocation where() const {
    const Token& token = tokens_[std::min(next_, tokens_.size() - 1)];
    return {file_, token.line, token.column};
  }
  std::string word() { return std::string(tokens_[next_++].text); }
  bool done() const { return next_ == tokens_.size(); }
  bool at_number() const { return !done() && parse_number(tokens_[next_].text).has_value(); }
  bool at(std::string_view what) const { return !done() && tokens_[next_].text == what; }
  void step() { ++next_; }

  double number(double low, const char* columns) {
    if (done()) bad_input(where(), "the line ends early, expected {}", columns);
    const auto value = parse_number(tokens_[next_].text);
    if (!value)
      bad_input(where(), "found {}, expected a number ({})", in_quotes(tokens_[next_].text), columns);
    if (!(std::abs(*value) <= largest_coordinate_m))
      bad_input(where(), "{} lies beyond 1e7", in_quotes(tokens_[next_].text));
    if (*value < low)
      bad_input(where(), "found {}, expected {}", in_quotes(tokens_[next_].text),
                low > 0 ? "a length above 0" : "no length below 0");
    ++next_;
    return *value;
  }
  Eigen::Vector3d place(const char* columns) {
    Eigen::Vector3d out;
    for (int k = 0; k < 3; ++k) out[k] = number(-largest_coordinate_m, columns);
    return out;
  }
  double size(const char* columns) { return number(smallest_size_m, columns); }

 private:
  const std::string& file_;
  std::vector<Token> tokens_;
  std::size_t next_ = 0;
};

bool read_closed(ShapeLine& line) {
  const bool open = line.at("open");
  if (open || line.at("closed")) line.step();
  return !open;
}

Shape read_pipe(ShapeLine& line, bool cone, const char* columns) {
  const SourceLocation start = line.where();
  const Eigen::Vector3d from = line.place(columns), to = line.place(columns);
  if (!((to - from).norm() >= smallest_size_m)) bad_input(start, "the two ends are the same point");
  if (!cone) {
    const double r = line.size(columns);
    return cylinder(from, to, r, r, read_closed(line));
  }
  const SourceLocation radii = line.where();
  const double r0 = line.number(0, columns), r1 = line.number(0, columns);
  if (!(std::max(r0, r1) >= smallest_size_m)) bad_input(radii, "both radii are 0");
  return cylinder(from, to, r0, r1, read_closed(line));
}

Shape read_spheroid(ShapeLine& line, const char* columns) {
  const Eigen::Vector3d centre = line.place(columns);
  const double across = line.size(columns), along = line.size(columns);
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  if (line.at_number()) {
    const SourceLocation start = line.where();
    axis = line.place(columns);
    if (!(axis.norm() > 0)) bad_input(start, "the axis is (0, 0, 0), expected a direction");
  }
  return ellipsoid(centre, {across, across, along},
                   Rotation(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis)));
}

Shape read_ellipsoid(ShapeLine& line, const char* columns) {
  const Eigen::Vector3d centre = line.place(columns);
  Eigen::Vector3d radii, turn = Eigen::Vector3d::Zero();
  for (double& r : radii) r = line.size(columns);
  if (line.at_number()) turn = line.place(columns);
  return ellipsoid(centre, radii, Rotation::about_axes(radians(turn[0]), radians(turn[1]), radians(turn[2])));
}

Shape read_shape(ShapeLine& line) {
  const SourceLocation start = line.where();
  const std::string word = line.word();
  const auto* found = std::find_if(std::begin(shape_words), std::end(shape_words),
                                   [&](const ShapeWord& known) { return word == known.name; });
  if (found == std::end(shape_words)) {
    std::vector<std::string> known;
    for (const ShapeWord& w : shape_words) known.emplace_back(w.name);
    bad_input(start, "there is no shape {}{}", in_quotes(word), did_you_mean(word, known));
  }
  const char* columns = found->columns;
  if (word == "sphere") {
    const Eigen::Vector3d centre = line.place(columns);
    return sphere(centre, line.size(columns));
  }
  if (word == "ellipsoid") return read_ellipsoid(line, columns);
  if (word == "spheroid") return read_spheroid(line, columns);
  return read_pipe(line, word == "cone", columns);
}

}  // namespace

std::vector<Shape> parse_shape_list(const std::string& path, std::string_view text,
                                    const std::string& material, const SourceLocation& where,
                                    MaterialNames& names) {
  TokenReader reader(path, text);
  std::vector<Shape> out;
  while (const auto first = reader.peek()) {
    std::vector<Token> tokens;
    for (auto token = first; token && token->line == first->line; token = reader.peek())
      tokens.push_back(*reader.next());
    ShapeLine line(path, std::move(tokens));
    Shape shape = read_shape(line);
    if (!line.done()) {
      if (line.at_number()) bad_input(line.where(), "too many numbers for this shape");
      const SourceLocation place = line.where();
      shape.material = names.number(line.word(), place);
    } else if (material.empty()) {
      bad_input({path, first->line, first->column},
                "no material: give one at the end of the line, or `material` for all of the prototype");
    } else {
      shape.material = names.number(material, where);
    }
    if (!line.done()) bad_input(line.where(), "found more behind the material, expected the line's end");
    out.push_back(shape);
  }
  if (out.empty()) bad_input({path}, "no lines, expected shapes (sphere x y z r, ...)");
  return out;
}

std::vector<Shape> read_shape_list(const std::string& path, const std::string& material,
                                   const SourceLocation& where, MaterialNames& names) {
  return parse_shape_list(path, read_text(path), material, where, names);
}

}  // namespace bpms
