// Boards and bundles of tags that other programs describe in YAML: Kalibr's checkerboard and circlegrid, and
// the tags.yaml of apriltag_ros. Kalibr's aprilgrid is refused: its black squares between the tags break the
// white border by which AprilTag 3 finds a tag.
#pragma once
#include <string>
#include <string_view>

#include "calibrate/targets/target.h"

namespace bpms {

Target parse_yaml_board(const std::string& path, std::string_view text);

}  // namespace bpms
