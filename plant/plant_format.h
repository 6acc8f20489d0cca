// The layout of plant texts: the same words in the same order, evenly spaced. Comments, includes, constants
// and expressions stay as they are; so do line breaks in the word. A block that stands in one line stays
// there if it fits, others have one attribute a line.
#pragma once
#include <string>
#include <string_view>

namespace bpms {

// Any plant text or library whose strings, brackets and blocks are closed; others are located errors.
// Formatting what is formatted changes nothing.
std::string formatted_plant(const std::string& path, std::string_view text);

}  // namespace bpms
