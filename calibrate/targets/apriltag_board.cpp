// apriltag:COLUMNSxROWS:TAG:GAP[:FIRST_ID]. Tags of family 36h11 with a border of one black bit and white
// between them; ids run row by row from the upper left one. The points are the corners of each black border:
// upper left (the origin on the first tag), upper right, lower right, lower left. Any part of the board will
// do.
#include "calibrate/targets/tag_detector.h"
#include "calibrate/targets/target_kind.h"
#include "core/text.h"

namespace bpms {
namespace {

constexpr int most_tags_in_a_row = tag_codes;
constexpr double largest_tag_m = 100;

class AprilTagBoardKind final : public TargetKind {
 public:
  std::string_view name() const override { return "apriltag"; }
  std::string_view form() const override { return "apriltag:COLUMNSxROWS:TAG:GAP"; }
  std::string_view example() const override { return "apriltag:6x4:40mm:10mm (tags 36h11)"; }

  void parse(SpecParts& parts, Target& target) const override {
    std::tie(target.columns, target.rows) = parts.counts(1, most_tags_in_a_row);
    target.mark_m = parts.length("tag", largest_tag_m);
    target.gap_m = parts.length("gap", largest_tag_m);
    if (!parts.empty()) {
      const auto id = parse_integer(parts.next("first id"));
      if (!id || *id < 0 || *id >= tag_codes)
        parts.reject(fmt::format("the first id is 0 to {}", tag_codes - 1));
      target.first_id = static_cast<int>(*id);
    }
  }
  void read(const TomlValue& root, Target& target) const override {
    target.columns = static_cast<int>(root.require("columns").integer(1, most_tags_in_a_row));
    target.rows = static_cast<int>(root.require("rows").integer(1, most_tags_in_a_row));
    target.mark_m = root.require("tag_m").positive();
    target.gap_m = root.require("gap_m").positive();
    if (const TomlValue id = root.get("first_id"))
      target.first_id = static_cast<int>(id.integer(0, tag_codes - 1));
  }
  std::string toml(const Target& target) const override {
    return fmt::format("columns = {}\nrows = {}\ntag_m = {}\ngap_m = {}\nfirst_id = {}\n", target.columns,
                       target.rows, toml_number(target.mark_m), toml_number(target.gap_m), target.first_id);
  }
  std::string nonsense(const Target& target) const override {
    const int last = target.first_id + target.columns * target.rows - 1;
    if (last >= tag_codes)
      return fmt::format("{}x{} tags from id {} on end at id {}; the family ends at {}", target.columns,
                         target.rows, target.first_id, last, tag_codes - 1);
    if (target.mark_m > largest_tag_m || target.gap_m > largest_tag_m)
      return "the tags or gaps are larger than 100 m";
    constexpr double rounding = 1e-9;
    if (target.gap_m < target.mark_m / tag_bits * (1 - rounding))
      return fmt::format(
          "a gap of {:.6g} m is too narrow: a tag of {:.6g} m needs a bit ({:.6g} m) of white "
          "around it",
          target.gap_m, target.mark_m, target.mark_m / tag_bits);
    return {};
  }

  std::vector<Eigen::Vector3d> designed_points_m(const Target& target) const override {
    std::vector<Eigen::Vector3d> out;
    for (int i = 0; i < target.columns * target.rows; ++i) {
      for (const Eigen::Vector3d& corner : unit_tag_corners())
        out.push_back(upper_left(target, i) + target.mark_m * (corner + Eigen::Vector3d(0.5, 0.5, 0)));
    }
    return out;
  }
  std::string point_name(const Target& target, int point) const override {
    return fmt::format("{}.{}", target.first_id + point / 4, point % 4);
  }
  std::vector<std::string> looks(const Target& target) const override {
    std::vector<std::string> out;
    for (int i = 0; i < target.columns * target.rows; ++i)
      out.push_back(fmt::format("tag {} of 36h11", target.first_id + i));
    return out;
  }

  Detection detect(const cv::Mat& grey, const Target& target) const override {
    std::set<int> wanted;
    for (int i = 0; i < target.columns * target.rows; ++i) wanted.insert(target.first_id + i);
    const SeenTags seen = find_tags(grey, wanted);
    Detection out;
    out.remarks = seen.remarks;
    for (const SeenTag& tag : seen.tags) {
      for (int i = 0; i < 4; ++i)
        out.corners.push_back({4 * (tag.id - target.first_id) + i, tag.corners[static_cast<std::size_t>(i)]});
    }
    if (!out.found()) out.trouble = "none of the board's tags found";
    return out;
  }

  Drawing draw(const Target& target) const override {
    Drawing out;
    const double bit = target.mark_m / tag_bits;
    for (int i = 0; i < target.columns * target.rows; ++i) {
      const Eigen::Vector3d at = upper_left(target, i);
      draw_bits(tag_pattern(target.first_id + i), at.x(), at.y(), bit, out);
    }
    const double pitch = target.mark_m + target.gap_m, white = std::max(target.gap_m, bit);
    out.quiet_low = Eigen::Vector2d::Constant(-white);
    out.quiet_high = {target.columns * pitch - target.gap_m + white,
                      target.rows * pitch - target.gap_m + white};
    out.caption =
        fmt::format("apriltag 36h11 {}x{}, ids {} to {}, tag {:.6g} mm, gap {:.6g} mm", target.columns,
                    target.rows, target.first_id, target.first_id + target.columns * target.rows - 1,
                    target.mark_m * 1e3, target.gap_m * 1e3);
    return out;
  }

 private:
  static Eigen::Vector3d upper_left(const Target& target, int tag) {
    const double pitch = target.mark_m + target.gap_m;
    const int row = tag / target.columns;
    return {tag % target.columns * pitch, row * pitch, 0};
  }
};

}  // namespace

const TargetKind& apriltag_kind() {
  static const AprilTagBoardKind kind;
  return kind;
}

}  // namespace bpms
