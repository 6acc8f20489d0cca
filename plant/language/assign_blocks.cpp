// Which block shapes which organ: block "l n" belongs to the leaves labelled n if there are any, else to the
// n-th leaf counting all of them; a block without a number to all leaves that have no block of their own.
#include <map>
#include <set>

#include "plant/language/parse.h"

namespace bpms {
namespace {

std::string name(const Symbol& symbol) {
  return symbol.label ? fmt::format("{}({})", letter(symbol.kind), *symbol.label)
                      : fmt::format("{} {}", organ_name(symbol.kind), symbol.ordinal);
}

void note(std::vector<std::string>& warnings, const SourceLocation& where, const std::string& message) {
  warnings.push_back(where.str() + ": " + message);
}

using Key = std::pair<OrganKind, int>;

void note_ambiguous_numbers(const OrganWord& plant, std::vector<std::string>& warnings) {
  std::map<Key, const Symbol*> by_ordinal;
  for (const Symbol& symbol : plant.word) {
    if (symbol.type == Symbol::Type::organ) by_ordinal[{symbol.kind, symbol.ordinal}] = &symbol;
  }
  std::set<Key> told;
  for (const Symbol& symbol : plant.word) {
    if (!symbol.label || !told.insert({symbol.kind, *symbol.label}).second) continue;
    const auto other = by_ordinal.find({symbol.kind, *symbol.label});
    if (other == by_ordinal.end() || other->second->label == symbol.label) continue;
    note(warnings, symbol.where,
         fmt::format("{} is a label here and also the ordinal of another {} (line {}, column {}); the block "
                     "'{} {}' belongs to the label",
                     *symbol.label, organ_name(symbol.kind), other->second->where.line,
                     other->second->where.column, letter(symbol.kind), *symbol.label));
  }
}

// The sizes that blocks lack: one note for each kind of organ and size, however many blocks it is.
void note_missing_sizes(const OrganWord& plant, std::vector<std::string>& warnings) {
  struct Size {
    const char* lack;
    bool (*is_lacking)(OrganKind, const OrganAttributes&);
  };
  constexpr Size sizes[] = {
      {"a_length and no extent",
       [](OrganKind kind, const OrganAttributes& a) { return kind != OrganKind::bud && a.length_m == 0; }},
      {"a_width and no surface",
       [](OrganKind kind, const OrganAttributes& a) { return kind == OrganKind::leaf && a.width_m == 0; }},
      {"a_radius and no surface",
       [](OrganKind kind, const OrganAttributes& a) { return kind != OrganKind::leaf && a.radius_m == 0; }},
  };
  for (const OrganKind kind : {OrganKind::bud, OrganKind::stem, OrganKind::leaf, OrganKind::head}) {
    for (const Size& size : sizes) {
      std::vector<const Block*> lacking;
      for (const Block& block : plant.blocks) {
        if (block.kind == kind && size.is_lacking(kind, block.attributes)) lacking.push_back(&block);
      }
      if (lacking.empty()) continue;
      std::string lines;
      for (std::size_t i = 1; i < lacking.size(); ++i)
        lines += fmt::format("{}{}", i > 1 ? ", " : "", lacking[i]->where.line);
      note(
          warnings, lacking[0]->where,
          fmt::format("this {} has no {}", organ_name(kind), size.lack) +
              (lines.empty() ? ""
                             : fmt::format("; the same at line{} {}", lacking.size() > 2 ? "s" : "", lines)));
    }
  }
}

void note_organs_without_block(const OrganWord& plant, std::vector<std::string>& warnings) {
  std::set<std::pair<int, int>> told;  // places: the organs of a repeated group share theirs
  for (const Symbol& symbol : plant.word) {
    if (symbol.type != Symbol::Type::organ || symbol.block >= 0) continue;
    if (!told.insert({symbol.where.line, symbol.where.column}).second) continue;
    note(warnings, symbol.where,
         fmt::format("{} has no block{}", name(symbol),
                     symbol.kind == OrganKind::rotation ? " and turns nothing" : " and no extent"));
  }
}

// The blocks that somebody uses or that the file itself has; those of libraries are there to choose from.
std::vector<Block> kept_blocks(std::vector<ParsedBlock>& parsed, std::vector<Symbol>& word) {
  std::vector<bool> used(parsed.size());
  for (const Symbol& symbol : word) {
    if (symbol.block >= 0) used[static_cast<std::size_t>(symbol.block)] = true;
  }
  std::vector<Block> out;
  std::vector<int> index(parsed.size(), -1);
  std::vector<ParsedBlock> kept;
  for (std::size_t i = 0; i < parsed.size(); ++i) {
    if (parsed[i].included && !used[i]) continue;
    index[i] = static_cast<int>(out.size());
    out.push_back(std::move(parsed[i].block));
    kept.push_back(std::move(parsed[i]));
  }
  parsed = std::move(kept);
  for (Symbol& symbol : word) {
    if (symbol.block >= 0) symbol.block = index[static_cast<std::size_t>(symbol.block)];
  }
  return out;
}

}  // namespace

OrganWord assign_blocks(std::vector<Symbol> word, std::vector<ParsedBlock>& blocks,
                        std::vector<std::string>& warnings) {
  std::map<Key, int> numbered;
  std::map<OrganKind, int> defaults;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& block = blocks[i].block;
    if (block.number)
      numbered[{block.kind, *block.number}] = static_cast<int>(i);
    else
      defaults[block.kind] = static_cast<int>(i);
  }
  std::set<Key> labels;
  for (const Symbol& symbol : word) {
    if (symbol.label) labels.insert({symbol.kind, *symbol.label});
  }
  for (Symbol& symbol : word) {
    if (symbol.type != Symbol::Type::organ) continue;
    const Key by_ordinal{symbol.kind, symbol.ordinal};
    if (symbol.label && numbered.contains({symbol.kind, *symbol.label})) {
      symbol.block = numbered[{symbol.kind, *symbol.label}];
    } else if (numbered.contains(by_ordinal) && !labels.contains(by_ordinal)) {
      symbol.block = numbered[by_ordinal];
    } else if (const auto found = defaults.find(symbol.kind); found != defaults.end()) {
      symbol.block = found->second;
    }
  }
  OrganWord out;
  out.blocks = kept_blocks(blocks, word);
  out.word = std::move(word);
  note_organs_without_block(out, warnings);
  note_ambiguous_numbers(out, warnings);
  std::vector<bool> used(out.blocks.size());
  for (const Symbol& symbol : out.word) {
    if (symbol.block >= 0) used[static_cast<std::size_t>(symbol.block)] = true;
  }
  for (std::size_t i = 0; i < out.blocks.size(); ++i) {
    const Block& block = out.blocks[i];
    if (!used[i])
      note(warnings, block.where,
           fmt::format("nothing uses the block '{}{}'", letter(block.kind),
                       block.number ? fmt::format(" {}", *block.number) : std::string()));
  }
  note_missing_sizes(out, warnings);
  for (const ParsedBlock& block : blocks)
    warnings.insert(warnings.end(), block.notes.begin(), block.notes.end());
  return out;
}

}  // namespace bpms
