#include <algorithm>
#include <filesystem>
#include <map>

#include "core/nearest.h"
#include "core/units.h"
#include "plant/language/attributes.h"
#include "plant/language/parse.h"

namespace bpms {
namespace {

const std::vector<std::string> units{"cm", "mm", "m"};

PlantTokens tokenise(const std::string& path, std::string_view text) {
  PlantTokens out{path, {}, {path}};
  TokenReader reader(path, text, "{}");
  while (const auto token = reader.next()) out.tokens.push_back(*token);
  out.end = reader.here();
  return out;
}

bool is_organ_letter(std::string_view text) {
  return text.size() == 1 && organ_letters.find(text) != std::string_view::npos;
}
bool like_number(std::string_view text) {
  return text.find_first_of("0123456789") != std::string_view::npos &&
         text.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
}

// The token where the first block begins: the letter before "{" or before "NUMBER {".
std::size_t first_block(const PlantTokens& text, std::size_t begin) {
  std::size_t brace = begin;
  while (brace < text.tokens.size() && text.tokens[brace].text != "{" && text.tokens[brace].text != "}")
    ++brace;
  if (brace == text.tokens.size()) return brace;
  if (text.tokens[brace].text == "}") syntax_error(text.where(brace), "'}}' without a block before it");
  const auto is_header = [&](std::size_t i) { return i >= begin && is_organ_letter(text.tokens[i].text); };
  if (brace > begin && is_header(brace - 1)) return brace - 1;
  if (brace > begin + 1 && like_number(text.tokens[brace - 1].text) && is_header(brace - 2)) return brace - 2;
  syntax_error(text.where(brace),
               "'{{' without an organ letter before it, expected a block such as 'l 1 {{'");
}

std::size_t parse_units(const PlantTokens& text, Plant& plant) {
  if (text.tokens.empty() || text.tokens[0].text != "units") return 0;
  if (text.tokens.size() < 2)
    syntax_error(text.end, "the file ends where a unit was expected: units cm, mm or m");
  const std::string unit(text.tokens[1].text);
  if (std::ranges::find(units, unit) == units.end())
    syntax_error(text.where(1), "unknown unit {}{}", in_quotes(unit), did_you_mean(unit, units));
  plant.unit = unit;
  return 2;
}

void refuse_second_block(const std::vector<Block>& blocks, const Block& block) {
  for (const Block& other : blocks) {
    if (other.kind != block.kind || other.number != block.number) continue;
    const std::string number = block.number ? fmt::format(" {}", *block.number) : std::string();
    semantic_error(block.where, "a second block '{}{}'; the first is at line {}", letter(block.kind), number,
                   other.where.line);
  }
}

}  // namespace

SourceLocation PlantTokens::where(std::size_t token) const {
  return token < tokens.size() ? SourceLocation{file, tokens[token].line, tokens[token].column} : end;
}

Plant parse_plant(const std::string& path, std::string_view text, const PlantReadOptions& options) {
  const PlantTokens tokens = tokenise(path, text);
  Plant plant;
  plant.name = std::filesystem::path(path).stem().string();
  std::size_t at = parse_units(tokens, plant);
  const double metres = metres_per_unit(plant.unit, {});
  const std::size_t blocks = first_block(tokens, at);
  if (blocks == at)
    syntax_error(tokens.where(at), "no word before the blocks, expected one such as [s[+l]h]");
  parse_word(tokens, at, blocks, options.lenient, plant);
  for (at = blocks; at < tokens.tokens.size();) {
    Block block = parse_block(tokens, at, metres);
    refuse_second_block(plant.blocks, block);
    plant.blocks.push_back(std::move(block));
  }
  assign_blocks(plant);
  return plant;
}

Plant read_plant(const std::string& path, const PlantReadOptions& options) {
  return parse_plant(path, read_text(path), options);
}

}  // namespace bpms
