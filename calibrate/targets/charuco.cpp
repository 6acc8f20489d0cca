// charuco:COLUMNSxROWS:SQUARE:MARKER:DICTIONARY. Columns and rows count squares, as everybody does who prints
// such boards; the points are the inner corners, row by row. Marker ids run row by row from the upper left.
// Any part of the board will do.
#include "calibrate/targets/charuco_detector.h"
#include "calibrate/targets/marker_dictionary.h"
#include "calibrate/targets/target_kind.h"
#include "core/nearest.h"

namespace bpms {
namespace {

constexpr int fewest_squares = 3, most_squares = 100;  // in a row
constexpr double largest_marked_square_m = 100;

class CharucoKind final : public TargetKind {
 public:
  std::string_view name() const override { return "charuco"; }
  std::string_view form() const override { return "charuco:COLUMNSxROWS:SQUARE:MARKER:DICTIONARY"; }
  std::string_view example() const override {
    return "charuco:11x8:30mm:22mm:DICT_5X5_250 (squares; then :legacy for OpenCV before 4.7)";
  }

  void parse(SpecParts& parts, Target& target) const override {
    std::tie(target.columns, target.rows) = parts.counts(fewest_squares, most_squares);
    target.square_m = parts.length("square", largest_marked_square_m);
    target.mark_m = parts.length("marker", largest_marked_square_m);
    target.dictionary = parts.next("dictionary");
    if (parts.empty()) return;
    if (parts.next("layout") != "legacy") parts.reject("the last part can only be legacy");
    target.first_square_white = target.rows % 2 == 0;
  }
  void read(const TomlValue& root, Target& target) const override {
    target.columns = static_cast<int>(root.require("columns").integer(fewest_squares, most_squares));
    target.rows = static_cast<int>(root.require("rows").integer(fewest_squares, most_squares));
    target.square_m = root.require("square_m").positive();
    target.mark_m = root.require("marker_m").positive();
    target.dictionary = root.require("dictionary").one_of(marker_dictionaries());
    if (const TomlValue id = root.get("first_id"))
      target.first_id = static_cast<int>(id.integer(0, marker_count(target.dictionary) - 1));
    target.first_square_white = root.boolean_or("first_square_white", false);
  }
  std::string toml(const Target& target) const override {
    return fmt::format(
        "columns = {}\nrows = {}\nsquare_m = {}\nmarker_m = {}\ndictionary = {}\nfirst_id = {}\n"
        "first_square_white = {}\n",
        target.columns, target.rows, toml_number(target.square_m), toml_number(target.mark_m),
        toml_string(target.dictionary), target.first_id, target.first_square_white);
  }
  std::string nonsense(const Target& target) const override {
    const std::vector<std::string> known = marker_dictionaries();
    if (std::find(known.begin(), known.end(), target.dictionary) == known.end())
      return fmt::format("no dictionary of markers {}{}", in_quotes(target.dictionary),
                         did_you_mean(target.dictionary, known));
    if (target.square_m > largest_marked_square_m) return "the squares are larger than 100 m";
    if (!(target.mark_m < target.square_m))
      return fmt::format("a marker of {:.6g} m does not fit into a square of {:.6g} m", target.mark_m,
                         target.square_m);
    const int last = target.first_id + markers(target) - 1, count = marker_count(target.dictionary);
    if (last >= count)
      return fmt::format("the board needs markers {} to {}; {} has {}", target.first_id, last,
                         target.dictionary, count);
    return {};
  }

  std::vector<Eigen::Vector3d> designed_points_m(const Target& target) const override {
    std::vector<Eigen::Vector3d> out;
    for (int row = 0; row + 1 < target.rows; ++row) {
      for (int column = 0; column + 1 < target.columns; ++column)
        out.emplace_back(column * target.square_m, row * target.square_m, 0);
    }
    return out;
  }
  std::vector<std::string> looks(const Target& target) const override {
    std::vector<std::string> out;
    for (int i = 0; i < markers(target); ++i)
      out.push_back(fmt::format("marker {} of {}", target.first_id + i, target.dictionary));
    return out;
  }
  Detection detect(const cv::Mat& grey, const Target& target) const override {
    return find_charuco(grey, target);
  }

  Drawing draw(const Target& target) const override {
    Drawing out;
    const double side = target.square_m, bit = target.mark_m / marker_bits(target.dictionary);
    for (int row = 0; row < target.rows; ++row) {
      for (int column = 0; column < target.columns; ++column) {
        const int id = charuco_marker_id(target, row, column);
        if (id < 0) {
          out.black.push_back({(column - 1) * side, (row - 1) * side, side, side});
          continue;
        }
        const Eigen::Vector2d at = charuco_marker_corner(target, row, column);
        draw_bits(marker_pattern(target.dictionary, id), at.x(), at.y(), bit, out);
      }
    }
    out.quiet_low = Eigen::Vector2d::Constant(-1.5 * side);
    out.quiet_high = Eigen::Vector2d(target.columns - 0.5, target.rows - 0.5) * side;
    out.caption = fmt::format("charuco {}x{} squares, {}, ids {} to {}, square {:.6g} mm, marker {:.6g} mm",
                              target.columns, target.rows, target.dictionary, target.first_id,
                              target.first_id + markers(target) - 1, side * 1e3, target.mark_m * 1e3);
    return out;
  }

 private:
  static int markers(const Target& target) {
    const int squares = target.columns * target.rows;
    return (squares + (target.first_square_white ? 1 : 0)) / 2;
  }
};

}  // namespace

const TargetKind& charuco_kind() {
  static const CharucoKind kind;
  return kind;
}

}  // namespace bpms
