// A library: a plant text without a word, included by others for its constants, organs and blocks.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bpms {

struct PlantLibrary {
  std::vector<std::string> constants, organs;
  std::size_t blocks = 0;
  std::vector<std::string> inputs;  // its own file first
};
// Nullopt for a text with a word, and for one with nothing but blocks: a plant whose word is missing.
std::optional<PlantLibrary> parse_plant_library(const std::string& path, std::string_view text);

}  // namespace bpms
