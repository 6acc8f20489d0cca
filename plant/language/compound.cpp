#include <algorithm>
#include <cmath>

#include "core/nearest.h"
#include "plant/language/attributes.h"
#include "plant/language/parse.h"

namespace bpms {
namespace {

constexpr std::size_t most_parts = 1'000'000, most_written_symbols = 100'000;
constexpr int deepest_nesting = 32;

struct DefinitionText {
  std::vector<Symbol> word;
  std::vector<ParsedBlock> blocks;
};

DefinitionText read_definition(const PlantNames& names, const OrganDefinition& definition,
                               const ParameterValues& values, bool lenient,
                               std::vector<std::string>& warnings) {
  DefinitionText out;
  const Scope scope{names, definition.order, &values};
  const std::size_t blocks = first_block(definition.body, 0);
  if (blocks == 0)
    syntax_error(definition.body.where(0), "no word in this organ, expected one such as s[+l]l");
  out.word = parse_word(definition.body, 0, blocks, scope, lenient, warnings);
  for (std::size_t at = blocks; at < definition.body.tokens.size();)
    add_block(out.blocks, parse_block(definition.body, at, definition.unit, scope));
  return out;
}

void add_once(std::vector<std::string>& all, const std::vector<std::string>& more) {
  for (const std::string& text : more) {
    if (std::ranges::find(all, text) == all.end()) all.push_back(text);
  }
}

}  // namespace

const OrganDefinition& CompoundBuilder::definition_of(const CompoundUse& use) const {
  const auto found = names_.organs.find(use.organ);
  if (found != names_.organs.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [name, definition] : names_.organs) known.push_back(name);
  semantic_error(use.where, "unknown organ {}{}", in_quotes(use.organ),
                 known.empty() ? "; organs are defined before the word: organ frond(len) { ... }"
                               : did_you_mean(use.organ, known));
}

ParameterValues CompoundBuilder::values_of(const OrganDefinition& definition, const CompoundUse& use) const {
  ParameterValues out;
  for (const OrganDefinition::Parameter& parameter : definition.parameters) {
    if (parameter.value) out[parameter.name] = *parameter.value;
  }
  for (const CompoundUse::Argument& argument : use.arguments) {
    const auto is_it = [&](const auto& parameter) { return parameter.name == argument.name; };
    if (std::ranges::none_of(definition.parameters, is_it)) {
      std::vector<std::string> known{"a_inclination", "a_azimuth", "a_twist"};
      for (const auto& parameter : definition.parameters) known.push_back(parameter.name);
      semantic_error(argument.where, "organ '{}' has no parameter {}{}", use.organ, in_quotes(argument.name),
                     did_you_mean(argument.name, known));
    }
    out[argument.name] = argument.value;
  }
  std::string missing;
  for (const OrganDefinition::Parameter& parameter : definition.parameters) {
    if (!out.contains(parameter.name)) missing += (missing.empty() ? "" : ", ") + parameter.name;
  }
  if (!missing.empty())
    semantic_error(use.where, "organ '{}' lacks {} (defined at {})", use.organ, missing,
                   definition.where.str());
  return out;
}

void CompoundBuilder::check_definitions() {
  for (const auto& [name, definition] : names_.organs) {
    ParameterValues unknown;
    for (const OrganDefinition::Parameter& parameter : definition.parameters)
      unknown[parameter.name] = std::numeric_limits<double>::quiet_NaN();
    std::vector<std::string> warnings;
    for (const ParsedBlock& parsed :
         read_definition(names_, definition, unknown, options_.lenient, warnings).blocks) {
      if (!parsed.use) continue;
      values_of(definition_of(*parsed.use), *parsed.use);
      uses_[name].push_back(*parsed.use);
    }
  }
  std::map<std::string, int> known;
  for (const auto& [name, definition] : names_.organs) {
    std::vector<std::string> chain;
    nesting(name, chain, known);
  }
}

// How many organs stand within each other in this one.
int CompoundBuilder::nesting(const std::string& organ, std::vector<std::string>& chain,
                             std::map<std::string, int>& known) const {
  if (const auto found = known.find(organ); found != known.end()) return found->second;
  chain.push_back(organ);
  int deepest = 1;
  if (const auto uses = uses_.find(organ); uses != uses_.end()) {
    for (const CompoundUse& use : uses->second) {
      if (const auto again = std::ranges::find(chain, use.organ); again != chain.end()) {
        std::string path;
        for (auto link = again; link != chain.end(); ++link) path += *link + " -> ";
        semantic_error(use.where, "an organ cannot be a part of itself: {}{}", path, use.organ);
      }
      deepest = std::max(deepest, 1 + nesting(use.organ, chain, known));
      if (deepest > deepest_nesting || static_cast<int>(chain.size()) > deepest_nesting)
        semantic_error(use.where, "more than {} organs within each other", deepest_nesting);
    }
  }
  chain.pop_back();
  return known[organ] = deepest;
}

int CompoundBuilder::instance(const CompoundUse& use) {
  const OrganDefinition& definition = definition_of(use);
  const ParameterValues values = values_of(definition, use);
  if (use.unit != definition.unit && !use.arguments.empty())
    add_once(plant_.warnings,
             {fmt::format("{}: organ '{}' is defined in a file with units {}, this one has units {}: its "
                          "parameters are numbers, taken as that file takes them",
                          use.where.str(), use.organ, definition.unit, use.unit)});
  std::vector<double> numbers;
  for (const auto& [name, value] : values) numbers.push_back(value);
  const std::pair key(use.organ, numbers);
  if (const auto known = instances_.find(key); known != instances_.end()) return known->second;
  std::vector<std::string> warnings;
  DefinitionText text = read_definition(names_, definition, values, options_.lenient, warnings);
  symbols_ += text.word.size() + text.blocks.size();
  if (symbols_ > most_written_symbols)
    semantic_error(use.where, "organs made of organs with more than {} symbols in all", most_written_symbols);
  CompoundOrgan organ;
  organ.name = use.organ;
  static_cast<OrganWord&>(organ) = assign_blocks(std::move(text.word), text.blocks, warnings);
  add_once(plant_.warnings, warnings);
  fill_in(organ, text.blocks);
  parts_.push_back(parts(organ, use.where));
  plant_.compounds.push_back(std::move(organ));
  return instances_[key] = static_cast<int>(plant_.compounds.size()) - 1;
}

void CompoundBuilder::fill_in(OrganWord& organs, const std::vector<ParsedBlock>& parsed) {
  for (std::size_t i = 0; i < organs.blocks.size(); ++i) {
    if (parsed[i].use) organs.blocks[i].compound = instance(*parsed[i].use);
  }
}

std::size_t CompoundBuilder::parts(const OrganWord& organs, const SourceLocation& where) const {
  std::size_t out = 0;
  for (const Symbol& symbol : organs.word) {
    if (symbol.type != Symbol::Type::organ || symbol.kind == OrganKind::rotation) continue;
    if (symbol.kind != OrganKind::compound) {
      ++out;
    } else if (symbol.block >= 0) {
      const int compound = organs.blocks[static_cast<std::size_t>(symbol.block)].compound;
      if (compound >= 0) out += parts_[static_cast<std::size_t>(compound)];
    }
    if (out > most_parts) semantic_error(where, "more than {} organs", most_parts);
  }
  return out;
}

}  // namespace bpms
