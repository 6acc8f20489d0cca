// Strings that are derived already: settings, if any, then modules.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "core/skip_blanks.h"
#include "core/text.h"
#include "core/units.h"
#include "plant/exchange/lsystem_parts.h"

namespace bpms {

const TurtleSymbol* turtle_symbol(char symbol) {
  static constexpr TurtleSymbol symbols[] = {
      {'F', 0, 1}, {'f', 0, 1},  {'G', 0, 1}, {'!', 0, 1},  {'+', 0, 1}, {'-', 0, 1}, {'&', 0, 1},
      {'^', 0, 1}, {'\\', 0, 1}, {'/', 0, 1}, {'|', 0, 0},  {'$', 0, 0}, {'[', 0, 0}, {']', 0, 0},
      {'{', 0, 0}, {'}', 0, 0},  {'.', 0, 0}, {'\'', 0, 1}, {';', 0, 1}};
  for (const TurtleSymbol& one : symbols)
    if (one.symbol == symbol) return &one;
  return nullptr;
}

bool is_lsystem_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

void LText::skip() {
  skip_blanks(text_, at_, line_, column_);
}

char LText::peek() {
  skip();
  return at_ < text_.size() ? text_[at_] : '\0';
}

char LText::take() {
  const char out = peek();
  if (out != 0) ++at_, ++column_;
  return out;
}

bool LText::arrow() {
  skip();
  return text_.substr(at_).starts_with("->");
}

SourceLocation LText::here() {
  skip();
  return {file_, line_, column_};
}

std::string_view LText::number() {
  skip();
  std::size_t end = at_;
  const auto digit = [&] {
    return end < text_.size() &&
           (std::isdigit(static_cast<unsigned char>(text_[end])) != 0 || text_[end] == '.');
  };
  while (digit()) ++end;
  if (end > at_ && end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
    std::size_t after = end + 1;
    if (after < text_.size() && (text_[after] == '+' || text_[after] == '-')) ++after;
    if (after < text_.size() && std::isdigit(static_cast<unsigned char>(text_[after])) != 0) {
      end = after;
      while (digit()) ++end;
    }
  }
  const std::string_view out = text_.substr(at_, end - at_);
  column_ += static_cast<int>(end - at_);
  at_ = end;
  return out;
}

std::string_view LText::name() {
  skip();
  std::size_t end = at_;
  while (end < text_.size() && (is_lsystem_letter(text_[end]) || text_[end] == '_' ||
                                (end > at_ && std::isdigit(static_cast<unsigned char>(text_[end])) != 0)))
    ++end;
  const std::string_view out = text_.substr(at_, end - at_);
  column_ += static_cast<int>(end - at_);
  at_ = end;
  return out;
}

bool read_lsetting(const std::string& file, std::string_view line, int number, LSettings& settings) {
  TokenReader reader(file, line);
  const auto word = reader.next();
  if (!word) return false;
  const auto at = [&](const Token& token) { return SourceLocation{file, number, token.column}; };
  const auto value = reader.next();
  if (word->text == "unit" || word->text == "width_unit") {
    if (!value) bad_input(at(*word), "{} without a unit, expected one like cm", word->text);
    metres_per_unit(value->text, at(*value));  // refuses what is none
    (word->text == "unit" ? settings.unit : settings.width_unit) = value->text;
  } else if (word->text == "angle" || word->text == "length" || word->text == "width") {
    const auto given = value ? parse_number(value->text) : std::nullopt;
    constexpr double largest = 1e6;
    if (!given || std::abs(*given) > largest || (word->text != "angle" && *given < 0))
      bad_input(at(value ? *value : *word), "expected a number behind {} (up to 1e6)", word->text);
    (word->text == "angle"    ? settings.angle_deg
     : word->text == "length" ? settings.length
                              : settings.width) = *given;
  } else {
    return false;
  }
  if (const auto more = reader.next())
    bad_input(at(*more), "found {}, expected the end of the line", in_quotes(more->text));
  return true;
}

std::string lsettings_text(const LSettings& s) {
  return fmt::format("unit {}\nwidth_unit {}\nangle {}\nlength {}\nwidth {}\n", s.unit, s.width_unit,
                     s.angle_deg, s.length, s.width);
}

void LBrackets::meet(char symbol, const SourceLocation& where) {
  if (symbol == '[' || symbol == '{') {
    open_.emplace_back(symbol, where);
  } else if (symbol == ']' || symbol == '}') {
    const char opening = symbol == ']' ? '[' : '{';
    if (open_.empty()) bad_input(where, "'{}' closes nothing", symbol);
    if (open_.back().first != opening)
      bad_input(where, "'{}' closes the '{}' of line {}, column {}", symbol, open_.back().first,
                open_.back().second.line, open_.back().second.column);
    open_.pop_back();
  }
}

void LBrackets::finish(const char* what) const {
  if (!open_.empty()) bad_input(open_.back().second, "'{}' is never closed in {}", open_.back().first, what);
}

namespace {

constexpr std::size_t most_string_modules = 20'000'000;

class LStringReader {
 public:
  LStringReader(const std::string& path, std::string_view text) : path_(path) {
    out_.file = path;
    int line = 1;
    for (;; ++line) {  // settings, comments and blank lines first
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view row = text.substr(0, end);
      const std::size_t first = row.find_first_not_of(" \t\r");
      const bool empty = first == std::string_view::npos || row[first] == '#';
      if (text.empty() || (!empty && !read_lsetting(path, row, line, out_.settings))) break;
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    text_.emplace(path, text, line);
  }

  LString read() {
    LBrackets brackets;
    while (!text_->done()) {
      const SourceLocation where = text_->here();
      if (out_.modules.size() >= most_string_modules)
        bad_input(where, "more than {} modules", most_string_modules);
      LModule module;
      module.symbol = text_->take();
      module.first = static_cast<std::uint32_t>(out_.parameters.size());
      if (text_->peek() == '(') module.count = read_parameters();
      brackets.meet(module.symbol, where);
      check(module, where);
      out_.modules.push_back(module);
    }
    brackets.finish("the string");
    if (out_.modules.empty()) bad_input(text_->here(), "no modules");
    if (!unknown_.empty())
      out_.notes.push_back(fmt::format("{}: symbols that draw nothing: {}", path_, fmt::join(unknown_, " ")));
    return std::move(out_);
  }

 private:
  std::uint8_t read_parameters() {
    text_->take();
    constexpr std::uint8_t most = 16;
    for (std::uint8_t count = 0;;) {
      const SourceLocation where = text_->here();
      double sign = 1;
      while (text_->peek() == '-' || text_->peek() == '+') sign *= text_->take() == '-' ? -1 : 1;
      const auto value = parse_number(text_->number());
      if (!value) bad_input(where, "expected a number in the parentheses of a module");
      out_.parameters.push_back(sign * *value);
      if (++count > most) bad_input(where, "more than {} parameters", most);
      const SourceLocation behind = text_->here();
      const char next = text_->take();
      if (next == ')') return count;
      if (next != ',') bad_input(behind, "expected ',' or ')' behind a parameter");
    }
  }

  void check(const LModule& module, const SourceLocation& where) {
    const TurtleSymbol* known = turtle_symbol(module.symbol);
    if (known == nullptr && !is_lsystem_letter(module.symbol))
      bad_input(where, "unknown symbol {}", in_quotes(std::string(1, module.symbol)));
    if (known == nullptr) unknown_.insert(module.symbol);
    if (known != nullptr && (module.count < known->least || module.count > known->most))
      bad_input(where, "'{}' with {} parameters, expected {}", module.symbol, module.count,
                known->most == 0 ? "none" : "none or one");
  }

  const std::string& path_;
  std::optional<LText> text_;
  LString out_;
  std::set<char> unknown_;
};

}  // namespace

LString parse_lstring(const std::string& path, std::string_view text) {
  return LStringReader(path, text).read();
}

LString read_lstring(const std::string& path) {
  return parse_lstring(path, read_text(path));
}

std::string lstring_text(const LString& string) {
  std::string out = lsettings_text(string.settings);
  std::size_t line = out.size();
  for (const LModule& module : string.modules) {
    constexpr std::size_t widest = 100;
    if (out.size() - line > widest) {
      out += '\n';
      line = out.size();
    }
    out += module.symbol;
    if (module.count == 0) continue;
    const double* first = string.parameters.data() + module.first;
    fmt::format_to(std::back_inserter(out), "({})", fmt::join(first, first + module.count, ","));
  }
  return out + "\n";
}

}  // namespace bpms
