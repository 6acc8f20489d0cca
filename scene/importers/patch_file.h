// Bicubic Bezier patches from text, metres: Newell's layout (.bpt: how many; then for each patch the degrees
// `3 3` and 16 points), or just 16 points after 16 points; '#' comments, optionally gzipped.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "plant/geometry/bezier.h"

namespace bpms {
// `metres_per_unit` scales the coordinates. Whatever is wrong is bad_input with line and column.
std::vector<BezierPatch> read_patch_file(const std::string& path, double metres_per_unit = 1);
std::vector<BezierPatch> parse_patches(const std::string& path, std::string_view text,
                                       double metres_per_unit = 1);
}  // namespace bpms
