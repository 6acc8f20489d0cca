// Lists of discs as RAMI gives them: rows `radius x y z nx ny nz` in metres, '#' comments, optionally
// gzipped.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace bpms {
// A radius that is not positive, a normal of length zero, a row of another width: bad_input with its line and
// column.
std::vector<Disc> read_disc_list(const std::string& path);
std::vector<Disc> parse_disc_list(const std::string& path, std::string_view text);
// Rows that read back as the same discs.
std::string disc_list_text(const std::vector<Disc>& discs);
}  // namespace bpms
