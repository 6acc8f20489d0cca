#include <cctype>

#include "plant/language/attributes.h"
#include "plant/language/parse.h"

namespace bpms {
namespace {

struct Character {
  char c;
  SourceLocation where;
};

// The word's characters; a blank stands between tokens, so that "l(1 2)" is not read as l(12).
std::vector<Character> characters(const PlantTokens& text, std::size_t begin, std::size_t end) {
  std::vector<Character> out;
  for (std::size_t i = begin; i < end; ++i) {
    const Token& token = text.tokens[i];
    for (std::size_t k = 0; k < token.text.size(); ++k)
      out.push_back({token.text[k], {text.file, token.line, token.column + static_cast<int>(k)}});
    out.push_back({' ', {text.file, token.line, token.column + static_cast<int>(token.text.size())}});
  }
  return out;
}

// "(12)" behind a letter; `i` is at the parenthesis and is moved behind it.
int parse_label(const std::vector<Character>& word, std::size_t& i) {
  const SourceLocation opened = word[i].where;
  std::string digits;
  for (++i; i < word.size() && word[i].c != ')'; ++i) digits += word[i].c;
  if (i == word.size()) syntax_error(opened, "label opened here is never closed, expected ')'");
  const auto first = digits.find_first_not_of(' ');
  const auto last = digits.find_last_not_of(' ');
  const std::string trimmed = first == std::string::npos ? "" : digits.substr(first, last - first + 1);
  const auto value = parse_integer(trimmed);
  constexpr long long largest = 1'000'000'000;
  if (!value || *value < 0 || *value > largest)
    syntax_error(opened, "label {}, expected a whole number such as l(1)", in_quotes("(" + trimmed + ")"));
  ++i;
  return static_cast<int>(*value);
}

struct Level {
  SourceLocation opened;
  char terminal;  // 'l' or 'h' once one stands in this bracket or, before this bracket opened, in the one
                  // around it
};

}  // namespace

void parse_word(const PlantTokens& text, std::size_t begin, std::size_t end, bool lenient, Plant& plant) {
  const std::vector<Character> word = characters(text, begin, end);
  std::vector<Level> levels{{{}, '\0'}};
  int count[organ_letters.size()] = {};
  for (std::size_t i = 0; i < word.size();) {
    const auto& [c, where] = word[i++];
    if (c == ' ') continue;
    Symbol symbol;
    symbol.where = where;
    if (c == '[') {
      symbol.type = Symbol::Type::open;
      levels.push_back({where, levels.back().terminal});
    } else if (c == ']') {
      symbol.type = Symbol::Type::close;
      if (levels.size() == 1) syntax_error(where, "']' closes a bracket that was never opened");
      levels.pop_back();
    } else if (const std::size_t kind = organ_letters.find(c); kind != std::string_view::npos) {
      symbol.type = Symbol::Type::organ;
      symbol.kind = static_cast<OrganKind>(kind);
      if (const char terminal = levels.back().terminal)
        semantic_error(where,
                       "'{}' after '{}' in the same bracket: nothing grows from a {}; put the '{}' into a "
                       "bracket of its own",
                       c, terminal, terminal == 'l' ? "leaf" : "head", terminal);
      symbol.ordinal = ++count[kind];
      while (i < word.size() && word[i].c == ' ' && i + 1 < word.size() && word[i + 1].c == '(') ++i;
      if (i < word.size() && word[i].c == '(') symbol.label = parse_label(word, i);
      if (c == 'l' || c == 'h') levels.back().terminal = c;
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      syntax_error(where, "a number in the word; a label is written in parentheses: l(1)");
    } else {
      syntax_error(where, "unknown letter {} in the word; known: b s l h + [ ]",
                   in_quotes(std::string(1, c)));
    }
    plant.word.push_back(symbol);
  }
  while (levels.size() > 1) {
    const SourceLocation opened = levels.back().opened;
    const std::string message = fmt::format("bracket opened at column {} is never closed", opened.column);
    if (!lenient)
      syntax_error(opened, "{}; put a ']' where its branch ends (--lenient closes it at the end of the word)",
                   message);
    plant.warnings.push_back(opened.str() + ": " + message + "; closed at the end of the word");
    Symbol close;
    close.type = Symbol::Type::close;
    close.where = text.where(end);
    plant.word.push_back(close);
    levels.pop_back();
  }
}

}  // namespace bpms
