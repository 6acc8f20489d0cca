#include <algorithm>
#include <filesystem>

#include "plant/language/attributes.h"
#include "plant/language/parse.h"
#include "plant/plant_library.h"

namespace bpms {
namespace {

bool is_organ_letter(std::string_view text) {
  return text.size() == 1 && organ_letters.find(text) != std::string_view::npos;
}
bool like_number(std::string_view text) {
  return text.find_first_of("0123456789") != std::string_view::npos &&
         text.find_first_not_of("+-.0123456789eE") == std::string_view::npos;
}

}  // namespace

bool begins_block(const PlantTokens& text, std::size_t at) {
  return at < text.tokens.size() && is_organ_letter(text.tokens[at].text) &&
         (text.is(at + 1, "{") || (text.is(at + 2, "{") && like_number(text.tokens[at + 1].text)));
}

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

Plant parse_plant(const std::string& path, std::string_view text, const PlantReadOptions& options) {
  const PlantTokens tokens = plant_tokens(path, text);
  PlantStatements statements;
  const std::size_t begin = read_statements(tokens, false, options, statements);
  Plant plant;
  plant.name = std::filesystem::path(path).stem().string();
  plant.unit = statements.unit;
  plant.inputs = statements.inputs;
  const std::size_t first = first_block(tokens, begin);
  if (first == begin)
    syntax_error(tokens.where(begin), "no word before the blocks, expected one such as [s[+l]h]");
  CompoundBuilder compounds(statements.names, options, plant);
  compounds.check_definitions();
  const Scope scope{statements.names};
  std::vector<Symbol> word = parse_word(tokens, begin, first, scope, options.lenient, plant.warnings);
  std::vector<ParsedBlock> blocks = std::move(statements.blocks);
  for (std::size_t at = first; at < tokens.tokens.size();)
    add_block(blocks, parse_block(tokens, at, plant.unit, scope));
  static_cast<OrganWord&>(plant) = assign_blocks(std::move(word), blocks, plant.warnings);
  compounds.fill_in(plant, blocks);
  compounds.parts(plant, tokens.where(begin));
  return plant;
}

Plant read_plant(const std::string& path, const PlantReadOptions& options) {
  return parse_plant(path, read_text(path), options);
}

std::optional<PlantLibrary> parse_plant_library(const std::string& path, std::string_view text) {
  const PlantTokens tokens = plant_tokens(path, text);
  const auto is_definition = [](const Token& token) {
    return token.text != "units" && is_statement(token.text);
  };
  if (std::ranges::none_of(tokens.tokens, is_definition)) return std::nullopt;
  PlantStatements statements;
  const PlantReadOptions options;
  const std::size_t begin = read_statements(tokens, false, options, statements);
  if (first_block(tokens, begin) != begin) return std::nullopt;
  statements = {};
  read_statements(tokens, true, options, statements);
  Plant plant;
  CompoundBuilder compounds(statements.names, options, plant);
  compounds.check_definitions();
  OrganWord all;
  for (const ParsedBlock& parsed : statements.blocks) all.blocks.push_back(parsed.block);
  compounds.fill_in(all, statements.blocks);
  PlantLibrary out;
  for (const auto& [name, constant] : statements.names.constants) out.constants.push_back(name);
  for (const auto& [name, organ] : statements.names.organs) out.organs.push_back(name);
  out.blocks = statements.blocks.size();
  out.inputs = statements.inputs;
  return out;
}

}  // namespace bpms
