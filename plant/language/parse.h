// The steps of reading a plant text: tokens -> statements (units, include, let, organ) -> word, blocks ->
// which block shapes which organ -> organs made of organs.
#pragma once
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plant/language/names.h"
#include "plant/plant.h"

namespace bpms {

// The text does not follow the grammar.
template <class... Args>
[[noreturn]] void syntax_error(const SourceLocation& where, fmt::format_string<Args...> format,
                               Args&&... args) {
  throw Error(ErrorKind::bad_input, where,
              "syntax error: " + fmt::format(format, std::forward<Args>(args)...));
}
// The grammar holds, but what is said cannot be.
template <class... Args>
[[noreturn]] void semantic_error(const SourceLocation& where, fmt::format_string<Args...> format,
                                 Args&&... args) {
  throw Error(ErrorKind::bad_input, where,
              "semantic error: " + fmt::format(format, std::forward<Args>(args)...));
}

// The word in tokens [begin, end): letters with labels, brackets balanced (with `lenient`: closed at the end,
// noted), groups <...>(n) repeated.
std::vector<Symbol> parse_word(const PlantTokens& text, std::size_t begin, std::size_t end,
                               const Scope& scope, bool lenient, std::vector<std::string>& warnings);
// The token where the first block begins: the letter before "{" or before "NUMBER {".
std::size_t first_block(const PlantTokens& text, std::size_t begin);
bool begins_block(const PlantTokens& text, std::size_t at);

// c 1 { organ frond len 12 }: which organ, and the values of its parameters.
struct CompoundUse {
  struct Argument {
    std::string name;
    double value = 0;
    SourceLocation where;
  };
  std::string organ;
  SourceLocation where;
  std::string unit;  // of the file that it stands in
  std::vector<Argument> arguments;
};

struct ParsedBlock {
  Block block;
  std::optional<CompoundUse> use;
  std::vector<std::string> notes;  // unlikely sizes
  bool included = false;           // from a library: left out when nothing uses it
};
// A block that begins at token `at`, which is moved behind it.
ParsedBlock parse_block(const PlantTokens& text, std::size_t& at, const std::string& unit,
                        const Scope& scope);
// Puts it behind the others; a second block of one letter and number is an error.
void add_block(std::vector<ParsedBlock>& blocks, ParsedBlock block);

// What is unlikely about an organ's sizes, with the unit that would make them likely. `where` gives the place
// of an attribute.
std::vector<std::string> size_notes(const Block& block, const std::string& unit,
                                    const std::function<SourceLocation(std::string_view attribute)>& where);

// Gives every organ its block; leaves out, among `blocks` too, what is included and not used; notes what is
// ambiguous, unused or missing.
OrganWord assign_blocks(std::vector<Symbol> word, std::vector<ParsedBlock>& blocks,
                        std::vector<std::string>& warnings);

// What a plant file and the libraries that it includes say before the word.
struct PlantStatements {
  PlantNames names;
  std::vector<ParsedBlock> blocks;  // of libraries
  std::string unit = "cm";
  std::vector<std::string> inputs;
  std::deque<std::string> texts;  // of included files: the tokens of definitions point into them
};
bool is_statement(std::string_view word);  // units, include, let, organ
// Reads them; the token behind them. A library has blocks among its statements, no word.
std::size_t read_statements(const PlantTokens& text, bool library, const PlantReadOptions& options,
                            PlantStatements& out);

// Organs made of organs: each use of a definition with its own values becomes one of Plant::compounds.
class CompoundBuilder {
 public:
  CompoundBuilder(const PlantNames& names, const PlantReadOptions& options, Plant& plant)
      : names_(names), options_(options), plant_(plant) {}
  // Reads every definition without values: names, recursion.
  void check_definitions();
  // Fills in Block::compound for blocks that were parsed as these.
  void fill_in(OrganWord& organs, const std::vector<ParsedBlock>& parsed);
  // Parts that a word has when its compound organs are taken apart; too many are an error at `where`.
  std::size_t parts(const OrganWord& organs, const SourceLocation& where) const;

 private:
  const OrganDefinition& definition_of(const CompoundUse& use) const;
  ParameterValues values_of(const OrganDefinition& definition, const CompoundUse& use) const;
  int instance(const CompoundUse& use);
  int nesting(const std::string& organ, std::vector<std::string>& chain,
              std::map<std::string, int>& known) const;

  const PlantNames& names_;
  const PlantReadOptions& options_;
  Plant& plant_;
  std::map<std::string, std::vector<CompoundUse>> uses_;  // by the organ whose blocks they stand in
  std::map<std::pair<std::string, std::vector<double>>, int> instances_;
  std::vector<std::size_t> parts_;  // of Plant::compounds
  std::size_t symbols_ = 0;
};

}  // namespace bpms
