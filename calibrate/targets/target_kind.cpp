#include "calibrate/targets/target_kind.h"

#include <array>
#include <opencv2/core.hpp>

#include "core/nearest.h"
#include "core/text.h"
#include "core/units.h"

namespace bpms {

const TargetKind &chessboard_kind(), &charuco_kind(), &apriltag_kind(), &control_frame_kind(),
    &circles_kind(), &asymmetric_circles_kind();

namespace {

constexpr std::array all_kinds{&chessboard_kind,    &charuco_kind, &apriltag_kind,
                               &control_frame_kind, &circles_kind, &asymmetric_circles_kind};

}  // namespace

SpecParts::SpecParts(std::string_view text, std::string_view form) : text_(text), form_(form) {
  rest_ = text_;
  next("kind");
}

void SpecParts::reject(const std::string& message) const {
  bad_input({}, "--target {}: {}, expected as in {}", in_quotes(text_), message, form_);
}

std::string_view SpecParts::next(const char* what) {
  if (rest_.empty()) reject(fmt::format("no {}", what));
  const std::size_t colon = rest_.find(':');
  const std::string_view out = rest_.substr(0, colon);
  rest_ = colon == std::string_view::npos ? std::string_view() : rest_.substr(colon + 1);
  return out;
}

std::pair<int, int> SpecParts::counts(int fewest, int most) {
  const std::string_view part = next("COLUMNSxROWS");
  const std::size_t cross = part.find('x');
  if (cross == std::string_view::npos) reject("no COLUMNSxROWS");
  const auto columns = parse_integer(part.substr(0, cross)), rows = parse_integer(part.substr(cross + 1));
  for (const auto& count : {columns, rows}) {
    if (!count || *count < fewest || *count > most)
      reject(fmt::format("columns and rows are {} to {}", fewest, most));
  }
  return {static_cast<int>(*columns), static_cast<int>(*rows)};
}

double SpecParts::length(const char* what, double largest_m) {
  const double out = parse_length(next(what), {"--target"});
  if (!(out > 0)) reject(fmt::format("the {} has no size", what));
  if (out > largest_m) reject(fmt::format("the {} is larger than {} m", what, largest_m));
  return out;
}

void TargetKind::parse(SpecParts& parts, Target&) const {
  parts.reject("comes from a file only");
}
std::string TargetKind::point_name(const Target&, int point) const {
  return std::to_string(point);
}
Drawing TargetKind::draw(const Target&) const {
  bad_input({}, "a target of kind {} is not printed as a whole", in_quotes(name()));
}

const TargetKind& target_kind(const std::string& name) {
  for (const auto& kind : all_kinds) {
    if (kind().name() == name) return kind();
  }
  bad_input({}, "no kind of target {}{}", in_quotes(name), did_you_mean(name, target_kind_names()));
}

std::vector<std::string> target_kind_names() {
  std::vector<std::string> out;
  for (const auto& kind : all_kinds) out.emplace_back(kind().name());
  return out;
}

std::vector<std::string> target_forms() {
  std::vector<std::string> out;
  for (const auto& kind : all_kinds) {
    if (!kind().form().empty()) out.emplace_back(kind().form());
  }
  return out;
}

Detection detect_target(const cv::Mat& grey, const Target& target) {
  return target_kind(target.kind).detect(grey, target);
}
Drawing draw_target(const Target& target) {
  return target_kind(target.kind).draw(target);
}

}  // namespace bpms
