#include <cmath>

#include "plant/language/attributes.h"
#include "plant/language/parse.h"

namespace bpms {
namespace {

constexpr std::size_t most_symbols = 100'000;
constexpr double most_repeats = 1000;

bool ends_branch(char c) {
  return c == 'l' || c == 'h' || c == 'c';
}

struct BracketLevel {
  SourceLocation opened;
  char terminal;  // 'l', 'h' or 'c' once one stands in this bracket or, before this bracket opened, in the
                  // one around it
};
struct RepeatedGroup {
  SourceLocation opened;
  std::size_t first;   // of its symbols
  std::size_t levels;  // brackets open where it begins
  char terminal;       // there
};

class WordParser {
 public:
  WordParser(const PlantTokens& text, std::size_t begin, std::size_t end, const Scope& scope)
      : text_(text), begin_(begin), at_(begin), end_(end), scope_(scope) {}

  std::vector<Symbol> parse(bool lenient, std::vector<std::string>& warnings) {
    while (at_ < end_) {
      const Token& token = text_.tokens[at_];
      if (token.text == "(" && may_have_label_) {
        word_.back().label = parse_label();
        may_have_label_ = false;
        continue;
      }
      if (is_statement(token.text)) syntax_error(text_.where(at_), "'{}' stands before the word", token.text);
      for (within_ = 0; within_ < token.text.size(); ++within_) parse_character(token.text[within_]);
      ++at_;
      if (group_closed_) repeat_group();
    }
    if (!groups_.empty())
      syntax_error(groups_.back().opened, "group opened here is never closed, expected '>' and its count");
    close_brackets(lenient, warnings);
    if (word_.empty()) semantic_error(text_.where(begin_), "the word is empty");
    number_organs();
    return std::move(word_);
  }

 private:
  SourceLocation here() const {
    SourceLocation out = text_.where(at_);
    out.column += static_cast<int>(within_);
    return out;
  }
  Symbol& add(Symbol::Type type) {
    if (word_.size() >= most_symbols) semantic_error(here(), "a word of more than {} symbols", most_symbols);
    Symbol& symbol = word_.emplace_back();
    symbol.type = type;
    symbol.where = here();
    return symbol;
  }

  void parse_character(char c) {
    if (group_closed_) refuse_without_count();
    may_have_label_ = false;
    if (c == '[') {
      levels_.push_back({here(), levels_.back().terminal});
      add(Symbol::Type::open);
    } else if (c == ']') {
      if (levels_.size() == 1) syntax_error(here(), "']' closes a bracket that was never opened");
      if (!groups_.empty() && groups_.back().levels == levels_.size())
        syntax_error(here(), "']' closes a bracket from outside the group '<' of column {}",
                     groups_.back().opened.column);
      levels_.pop_back();
      add(Symbol::Type::close);
    } else if (c == '<') {
      groups_.push_back({here(), word_.size(), levels_.size(), levels_.back().terminal});
    } else if (c == '>') {
      close_group();
    } else if (const std::size_t kind = organ_letters.find(c); kind != std::string_view::npos) {
      parse_organ(c, static_cast<OrganKind>(kind));
    } else if (c >= '0' && c <= '9') {
      syntax_error(here(), "a number in the word; a label is written in parentheses: l(1)");
    } else {
      syntax_error(here(), "unknown letter {} in the word; known: b s l h c + [ ] < >",
                   in_quotes(std::string(1, c)));
    }
  }

  void parse_organ(char c, OrganKind kind) {
    if (const char terminal = levels_.back().terminal)
      semantic_error(here(),
                     "'{}' after '{}' in the same bracket: nothing grows from a {}; put the '{}' into a "
                     "bracket of its own",
                     c, terminal,
                     terminal == 'l'   ? "leaf"
                     : terminal == 'h' ? "head"
                                       : "compound organ",
                     terminal);
    add(Symbol::Type::organ).kind = kind;
    if (ends_branch(c)) levels_.back().terminal = c;
    may_have_label_ = true;
  }

  // "(12)" behind a letter.
  int parse_label() {
    const SourceLocation opened = text_.where(at_);
    std::string label;
    for (++at_; at_ < end_ && text_.tokens[at_].text != ")"; ++at_)
      label += (label.empty() ? "" : " ") + std::string(text_.tokens[at_].text);
    if (at_ == end_) syntax_error(opened, "label opened here is never closed, expected ')'");
    ++at_;
    const auto value = parse_integer(label);
    constexpr long long largest = 1'000'000'000;
    if (!value || *value < 0 || *value > largest)
      syntax_error(opened, "label {}, expected a whole number such as l(1)", in_quotes("(" + label + ")"));
    return static_cast<int>(*value);
  }

  void close_group() {
    if (groups_.empty()) syntax_error(here(), "'>' closes a group that was never opened");
    if (levels_.size() != groups_.back().levels)
      syntax_error(levels_.back().opened, "bracket opened at column {} is not closed within its group <...>",
                   levels_.back().opened.column);
    group_closed_ = true;
  }
  [[noreturn]] void refuse_without_count() const {
    syntax_error(groups_.back().opened,
                 "a group without its count, expected a number in parentheses: <s[+l]>(3)");
  }

  void repeat_group() {
    if (at_ >= end_ || text_.tokens[at_].text != "(") refuse_without_count();
    const RepeatedGroup group = groups_.back();
    const SourceLocation where = text_.where(at_);
    const double count = read_number(text_, at_, scope_, "how often the group is repeated");
    groups_.pop_back();
    group_closed_ = false;
    if (std::isnan(count)) return;  // depends on a parameter without a value: once will do
    if (!(count >= 0 && count <= most_repeats && count == std::floor(count)))
      semantic_error(where, "a group is repeated {} times, expected a whole number up to {}", count,
                     most_repeats);
    if (count == 0) {
      word_.resize(group.first);
      levels_.back().terminal = group.terminal;
      return;
    }
    if (count > 1 && levels_.back().terminal != group.terminal)
      semantic_error(group.opened,
                     "the repeated group ends with '{}': nothing grows from that; put it into a bracket",
                     levels_.back().terminal);
    const std::size_t size = word_.size() - group.first;
    if (group.first + size * static_cast<std::size_t>(count) > most_symbols)
      semantic_error(where, "a word of more than {} symbols", most_symbols);
    for (std::size_t k = size; k < size * static_cast<std::size_t>(count); ++k) {
      Symbol copy = word_[group.first + k % size];
      word_.push_back(std::move(copy));
    }
  }

  void close_brackets(bool lenient, std::vector<std::string>& warnings) {
    for (; levels_.size() > 1; levels_.pop_back()) {
      const SourceLocation opened = levels_.back().opened;
      const std::string message = fmt::format("bracket opened at column {} is never closed", opened.column);
      if (!lenient)
        syntax_error(opened,
                     "{}; put a ']' where its branch ends (--lenient closes it at the end of the word)",
                     message);
      warnings.push_back(opened.str() + ": " + message + "; closed at the end of the word");
      Symbol& close = word_.emplace_back();
      close.type = Symbol::Type::close;
      close.where = text_.where(end_);
    }
  }

  void number_organs() {
    int count[organ_letters.size()] = {};
    for (Symbol& symbol : word_) {
      if (symbol.type == Symbol::Type::organ) symbol.ordinal = ++count[static_cast<std::size_t>(symbol.kind)];
    }
  }

  const PlantTokens& text_;
  std::size_t begin_, at_, end_;
  std::size_t within_ = 0;
  const Scope& scope_;
  std::vector<Symbol> word_;
  std::vector<BracketLevel> levels_{{{}, '\0'}};
  std::vector<RepeatedGroup> groups_;
  bool group_closed_ = false;  // its count comes next
  bool may_have_label_ = false;
};

}  // namespace

std::vector<Symbol> parse_word(const PlantTokens& text, std::size_t begin, std::size_t end,
                               const Scope& scope, bool lenient, std::vector<std::string>& warnings) {
  return WordParser(text, begin, end, scope).parse(lenient, warnings);
}

}  // namespace bpms
