// chessboard:COLUMNSxROWS:SQUARE. The points are the inner corners, row by row; the first square, above and
// left of the first point, is dark.
#include <opencv2/core.hpp>

#include "calibrate/targets/chessboard_detector.h"
#include "calibrate/targets/target_kind.h"

namespace bpms {
namespace {

constexpr int fewest_corners = 3, most_corners = 200;  // in a row; OpenCV finds none below 3
constexpr double largest_square_m = 100;

class ChessboardKind final : public TargetKind {
 public:
  std::string_view name() const override { return "chessboard"; }
  std::string_view form() const override { return "chessboard:COLUMNSxROWS:SQUARE"; }
  std::string_view example() const override { return "chessboard:9x6:25mm (inner corners)"; }

  void parse(SpecParts& parts, Target& target) const override {
    std::tie(target.columns, target.rows) = parts.counts(fewest_corners, most_corners);
    target.square_m = parts.length("square", largest_square_m);
  }
  void read(const TomlValue& root, Target& target) const override {
    target.columns = static_cast<int>(root.require("columns").integer(fewest_corners, most_corners));
    target.rows = static_cast<int>(root.require("rows").integer(fewest_corners, most_corners));
    const TomlValue square = root.require("square_m");
    target.square_m = square.positive();
    if (target.square_m > largest_square_m) square.reject("expected a square of at most 100 m");
  }
  std::string toml(const Target& target) const override {
    return fmt::format("columns = {}\nrows = {}\nsquare_m = {}\n", target.columns, target.rows,
                       toml_number(target.square_m));
  }

  std::vector<Eigen::Vector3d> designed_points_m(const Target& target) const override {
    std::vector<Eigen::Vector3d> out;
    for (int row = 0; row < target.rows; ++row) {
      for (int column = 0; column < target.columns; ++column)
        out.emplace_back(column * target.square_m, row * target.square_m, 0);
    }
    return out;
  }
  bool half_turn_alike(const Target& target) const override {
    return (target.columns + target.rows) % 2 == 0;
  }
  std::vector<std::string> looks(const Target& target) const override {
    const auto [least, most] = std::minmax(target.columns, target.rows);
    return {fmt::format("{}x{} inner corners", most, least)};
  }

  Detection detect(const cv::Mat& grey, const Target& target) const override {
    Detection out;
    const auto corners = find_chessboard(grey, target);
    if (!corners) out.trouble = fmt::format("no whole {}x{} chessboard found", target.columns, target.rows);
    for (std::size_t i = 0; corners && i < corners->size(); ++i)
      out.corners.push_back({static_cast<int>(i), (*corners)[i]});
    return out;
  }

  Drawing draw(const Target& target) const override {
    Drawing out;
    const double side = target.square_m;
    for (int row = -1; row < target.rows; ++row) {
      for (int column = -1; column < target.columns; ++column) {
        if ((row + column) % 2 == 0) out.black.push_back({column * side, row * side, side, side});
      }
    }
    out.quiet_low = Eigen::Vector2d::Constant(-1.5 * side);
    out.quiet_high = Eigen::Vector2d(target.columns + 0.5, target.rows + 0.5) * side;
    out.caption = fmt::format("chessboard {}x{} inner corners, square {:.6g} mm", target.columns, target.rows,
                              side * 1e3);
    return out;
  }
};

}  // namespace

const TargetKind& chessboard_kind() {
  static const ChessboardKind kind;
  return kind;
}

}  // namespace bpms
