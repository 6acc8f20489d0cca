// Blanks, line breaks and comments (# to the end of the line) of texts whose places are kept.
#pragma once
#include <cstddef>
#include <string_view>

namespace bpms {
// Moves `at` to the next character that says something, with its line and column.
void skip_blanks(std::string_view text, std::size_t& at, int& line, int& column);
}  // namespace bpms
