// circles:COLUMNSxROWS:PITCH:DIAMETER, a grid of dark circles, and asymmetric_circles:..., whose odd rows are
// shifted by half a step, as OpenCV's: PITCH is the distance between rows there, and circles of a row are two
// pitches apart. The points are the middles, row by row; the whole board must be seen.
#include <numbers>

#include "calibrate/targets/circle_detector.h"
#include "calibrate/targets/target_kind.h"

namespace bpms {
namespace {

constexpr int fewest_circles = 2, most_circles = 100;  // in a row
constexpr double largest_pitch_m = 100;

class CirclesKind final : public TargetKind {
 public:
  explicit CirclesKind(bool asymmetric) : asymmetric_(asymmetric) {}
  std::string_view name() const override { return asymmetric_ ? "asymmetric_circles" : "circles"; }
  std::string_view form() const override {
    return asymmetric_ ? "asymmetric_circles:COLUMNSxROWS:PITCH:DIAMETER"
                       : "circles:COLUMNSxROWS:PITCH:DIAMETER";
  }
  std::string_view example() const override {
    return asymmetric_ ? "asymmetric_circles:4x11:20mm:15mm" : "circles:9x6:25mm:15mm";
  }

  void parse(SpecParts& parts, Target& target) const override {
    std::tie(target.columns, target.rows) = parts.counts(fewest_circles, most_circles);
    target.square_m = parts.length("pitch", largest_pitch_m);
    target.mark_m = parts.length("diameter", largest_pitch_m);
  }
  void read(const TomlValue& root, Target& target) const override {
    target.columns = static_cast<int>(root.require("columns").integer(fewest_circles, most_circles));
    target.rows = static_cast<int>(root.require("rows").integer(fewest_circles, most_circles));
    target.square_m = root.require("pitch_m").positive();
    target.mark_m = root.require("diameter_m").positive();
  }
  std::string toml(const Target& target) const override {
    return fmt::format("columns = {}\nrows = {}\npitch_m = {}\ndiameter_m = {}\n", target.columns,
                       target.rows, toml_number(target.square_m), toml_number(target.mark_m));
  }
  std::string nonsense(const Target& target) const override {
    if (target.square_m > largest_pitch_m) return "the pitch is larger than 100 m";
    // In between there must be white, or the circles are one.
    constexpr double most_of_distance = 0.8;
    const double distance = target.square_m * (asymmetric_ ? std::numbers::sqrt2 : 1);
    if (target.mark_m > most_of_distance * distance)
      return fmt::format(
          "circles of {:.6g} m are too wide for {:.6g} m between their middles, at most {} of it",
          target.mark_m, distance, most_of_distance);
    return {};
  }

  std::vector<Eigen::Vector3d> designed_points_m(const Target& target) const override {
    std::vector<Eigen::Vector3d> out;
    for (int row = 0; row < target.rows; ++row) {
      for (int column = 0; column < target.columns; ++column)
        out.emplace_back((asymmetric_ ? 2 * column + row % 2 : column) * target.square_m,
                         row * target.square_m, 0);
    }
    return out;
  }
  // An asymmetric grid with an odd number of rows begins and ends with a row of the same shift; half a turn
  // moves it.
  bool half_turn_alike(const Target& target) const override { return !asymmetric_ || target.rows % 2 == 0; }
  std::vector<std::string> looks(const Target& target) const override {
    const auto [least, most] = std::minmax(target.columns, target.rows);
    return {fmt::format("{} {}x{}", name(), most, least)};
  }

  Detection detect(const cv::Mat& grey, const Target& target) const override {
    CircleGrid grid{target.columns, target.rows, asymmetric_, target.mark_m / 2, {}};
    for (const Eigen::Vector3d& x : target.points_m()) grid.centres_m.push_back(x.head<2>());
    Detection out;
    const auto middles = find_circles(grey, grid);
    if (!middles)
      out.trouble = fmt::format("no whole {}x{} grid of circles found", target.columns, target.rows);
    for (std::size_t i = 0; middles && i < middles->size(); ++i)
      out.corners.push_back({static_cast<int>(i), (*middles)[i]});
    return out;
  }

  Drawing draw(const Target& target) const override {
    Drawing out;
    for (const Eigen::Vector3d& x : designed_points_m(target))
      out.discs.push_back({x.x(), x.y(), target.mark_m / 2});
    const double around = target.square_m;
    out.quiet_low = Eigen::Vector2d::Constant(-around);
    out.quiet_high = Eigen::Vector2d::Constant(around);
    for (const Eigen::Vector3d& x : designed_points_m(target))
      out.quiet_high = out.quiet_high.cwiseMax(x.head<2>() + Eigen::Vector2d::Constant(around));
    out.caption = fmt::format("{} {}x{}, pitch {:.6g} mm, diameter {:.6g} mm", name(), target.columns,
                              target.rows, target.square_m * 1e3, target.mark_m * 1e3);
    return out;
  }

 private:
  bool asymmetric_;
};

}  // namespace

const TargetKind& circles_kind() {
  static const CirclesKind kind(false);
  return kind;
}
const TargetKind& asymmetric_circles_kind() {
  static const CirclesKind kind(true);
  return kind;
}

}  // namespace bpms
