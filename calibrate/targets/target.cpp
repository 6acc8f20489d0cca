#include "calibrate/targets/target.h"

#include "core/text.h"
#include "core/toml.h"
#include "core/units.h"

namespace bpms {
namespace {

constexpr int fewest_corners = 3, most_corners = 200;  // in a row; OpenCV finds none below 3
constexpr double largest_square_m = 100;

}  // namespace

std::vector<Eigen::Vector3d> Target::points_m() const {
  std::vector<Eigen::Vector3d> out;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) out.emplace_back(column * square_m, row * square_m, 0);
  }
  return out;
}

std::vector<Eigen::Vector2d> Target::bending() const {
  std::vector<Eigen::Vector2d> out;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x = 2.0 * column / (columns - 1) - 1, y = 2.0 * row / (rows - 1) - 1;
      out.emplace_back(1 - x * x, 1 - y * y);
    }
  }
  return out;
}

Target parse_target(const std::string& text) {
  const std::string prefix = "chessboard:";
  if (!text.starts_with(prefix)) {
    if (text.ends_with(".toml")) return read_board(text);
    bad_input({},
              "--target {}: expected chessboard:COLUMNSxROWS:SQUARE (chessboard:9x6:25mm), or a board.toml",
              in_quotes(text));
  }
  const std::string_view rest = std::string_view(text).substr(prefix.size());
  const std::size_t cross = rest.find('x'), colon = rest.find(':');
  const auto expected = [&](const char* what) {
    bad_input({}, "--target {}: {}, expected as in chessboard:9x6:25mm", in_quotes(text), what);
  };
  if (cross == std::string_view::npos || colon == std::string_view::npos || cross > colon)
    expected("no COLUMNSxROWS:SQUARE");
  const auto columns = parse_integer(rest.substr(0, cross));
  const auto rows = parse_integer(rest.substr(cross + 1, colon - cross - 1));
  for (const auto& count : {columns, rows}) {
    if (!count || *count < fewest_corners || *count > most_corners)
      expected("columns and rows are 3 to 200 inner corners");
  }
  Target target;
  target.columns = static_cast<int>(*columns);
  target.rows = static_cast<int>(*rows);
  target.square_m = parse_length(rest.substr(colon + 1), {"--target"});
  if (!(target.square_m > 0)) expected("the square has no size");
  if (target.square_m > largest_square_m) expected("the square is larger than 100 m");
  return target;
}

Target read_board(const std::string& path) {
  const TomlDocument document = TomlDocument::read(path);
  const TomlValue root = document.root();
  Target target;
  target.kind =
      root.require("kind").one_of({"chessboard", "charuco", "apriltag", "circles", "control_frame"});
  if (target.kind != "chessboard") root.get("kind").reject("this version detects chessboards only");
  target.columns = static_cast<int>(root.require("columns").integer(fewest_corners, most_corners));
  target.rows = static_cast<int>(root.require("rows").integer(fewest_corners, most_corners));
  const TomlValue square = root.require("square_m");
  target.square_m = square.positive();
  if (target.square_m > largest_square_m) square.reject("expected a square of at most 100 m");
  document.finish();
  return target;
}

std::string board_toml(const Target& target) {
  return fmt::format("kind = {}\ncolumns = {}\nrows = {}\nsquare_m = {}\n", toml_string(target.kind),
                     target.columns, target.rows, toml_number(target.square_m));
}

}  // namespace bpms
