// Arithmetic in the place of a number. By precedence: + and -, * and /, signs, ^ (from the right).
#include <charconv>
#include <cmath>

#include "core/nearest.h"
#include "core/units.h"
#include "plant/language/names.h"
#include "plant/language/parse.h"

namespace bpms {
namespace {

struct NumberFunction {
  std::string_view name;
  int arguments;
  double (*value)(double a, double b);
};
constexpr NumberFunction number_functions[] = {
    {"sqrt", 1, [](double a, double) { return std::sqrt(a); }},
    {"abs", 1, [](double a, double) { return std::abs(a); }},
    {"floor", 1, [](double a, double) { return std::floor(a); }},
    {"min", 2, [](double a, double b) { return std::isnan(a) || a < b ? a : b; }},
    {"max", 2, [](double a, double b) { return std::isnan(a) || a > b ? a : b; }},
    {"sin_deg", 1, [](double a, double) { return std::sin(radians(a)); }},
    {"cos_deg", 1, [](double a, double) { return std::cos(radians(a)); }},
    {"tan_deg", 1, [](double a, double) { return std::tan(radians(a)); }},
};

class ExpressionReader {
 public:
  ExpressionReader(const PlantTokens& text, std::size_t& at, const Scope& scope)
      : text_(text), token_(at), scope_(scope) {}

  double read() { return parenthesised(); }

 private:
  std::string_view rest() {
    if (token_ < text_.tokens.size() && within_ == text_.tokens[token_].text.size()) ++token_, within_ = 0;
    return token_ < text_.tokens.size() ? text_.tokens[token_].text.substr(within_) : std::string_view();
  }
  char peek() {
    const std::string_view ahead = rest();
    return ahead.empty() ? '\0' : ahead.front();
  }
  SourceLocation here() {
    rest();
    SourceLocation out = text_.where(token_);
    if (token_ < text_.tokens.size()) out.column += static_cast<int>(within_);
    return out;
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++within_;
    return true;
  }
  [[noreturn]] void expected(const SourceLocation& opened, std::string_view what) {
    const std::string_view found = rest();
    if (found.empty() || found == "{" || found == "}")
      syntax_error(opened, "expression opened here is never closed, expected ')'");
    syntax_error(here(), "found {} in an expression, expected {}", in_quotes(found), what);
  }

  double parenthesised() {
    const SourceLocation opened = here();
    constexpr int deepest = 60;
    if (++depth_ > deepest) syntax_error(opened, "more than {} parentheses within each other", deepest);
    take('(');
    const double value = sum(opened);
    if (!take(')')) expected(opened, "an operator or ')'");
    rest();  // moves to the next token
    --depth_;
    return value;
  }

  double checked(double value, const SourceLocation& where, bool known) {
    if (known && !std::isfinite(value))
      semantic_error(where, "the result is {}, expected a finite number",
                     std::isnan(value) ? "not a number" : "too large");
    return value;
  }

  double sum(const SourceLocation& opened) {
    double value = product(opened);
    for (;;) {
      const SourceLocation where = here();
      const char c = peek();
      if (c != '+' && c != '-') return value;
      take(c);
      const double other = product(opened);
      value = checked(c == '+' ? value + other : value - other, where, known(value, other));
    }
  }

  double product(const SourceLocation& opened) {
    double value = signed_power(opened);
    for (;;) {
      const SourceLocation where = here();
      const char c = peek();
      if (c != '*' && c != '/') return value;
      take(c);
      const double other = signed_power(opened);
      if (c == '/' && other == 0) semantic_error(where, "division by zero");
      value = checked(c == '*' ? value * other : value / other, where, known(value, other));
    }
  }

  double signed_power(const SourceLocation& opened) {
    bool negative = false;
    for (;;) {
      if (take('-'))
        negative = !negative;
      else if (!take('+'))
        break;
    }
    const double base = primary(opened);
    const SourceLocation where = here();
    double value = base;
    if (take('^')) {
      constexpr int deepest = 60;
      if (++depth_ > deepest) syntax_error(where, "more than {} powers within each other", deepest);
      const double exponent = signed_power(opened);
      --depth_;
      value = known(base, exponent) ? checked(std::pow(base, exponent), where, true) : unknown;
    }
    return negative ? -value : value;
  }

  double primary(const SourceLocation& opened) {
    const char c = peek();
    if (c == '(') return parenthesised();
    const std::string_view ahead = rest();
    if ((c >= '0' && c <= '9') || c == '.') {
      double value = 0;
      const auto [end, code] = std::from_chars(ahead.data(), ahead.data() + ahead.size(), value);
      if (code != std::errc{}) expected(opened, "a finite number");
      within_ += static_cast<std::size_t>(end - ahead.data());
      return value;
    }
    std::size_t length = 0;
    while (length < ahead.size() && is_identifier(ahead.substr(0, length + 1))) ++length;
    if (length == 0) expected(opened, "a number, a name or '('");
    const SourceLocation where = here();
    const std::string_view name = ahead.substr(0, length);
    within_ += length;
    return peek() == '(' ? call(name, where) : value_of(name, where);
  }

  double call(std::string_view name, const SourceLocation& where) {
    const NumberFunction* found = nullptr;
    std::vector<std::string> names;
    for (const NumberFunction& function : number_functions) {
      names.emplace_back(function.name);
      if (function.name == name) found = &function;
    }
    if (found == nullptr)
      syntax_error(where, "unknown function {}{}", in_quotes(name), did_you_mean(name, names));
    const SourceLocation opened = here();
    constexpr int deepest = 60;
    if (++depth_ > deepest) syntax_error(opened, "more than {} parentheses within each other", deepest);
    take('(');
    double values[2] = {sum(opened), 0};
    for (int i = 1; i < found->arguments; ++i) {
      if (!take(',')) expected(opened, fmt::format("',': {} takes {} numbers", name, found->arguments));
      values[i] = sum(opened);
    }
    if (!take(')')) expected(opened, fmt::format("')': {} takes {} number(s)", name, found->arguments));
    rest();
    --depth_;
    if (!known(values[0], values[1])) return unknown;
    return checked(found->value(values[0], values[1]), where, true);
  }

  double value_of(std::string_view name, const SourceLocation& where) {
    if (scope_.parameters != nullptr) {
      if (const auto found = scope_.parameters->find(name); found != scope_.parameters->end())
        return found->second;
    }
    const auto found = scope_.names.constants.find(name);
    if (found != scope_.names.constants.end() && found->second.order < scope_.order)
      return found->second.value;
    if (found != scope_.names.constants.end())
      semantic_error(where, "'{}' is used before its definition at {}", name, found->second.where.str());
    for (std::size_t i = token_; i + 1 < text_.tokens.size(); ++i) {
      if (text_.tokens[i].text == "let" && text_.tokens[i + 1].text == name)
        semantic_error(where, "'{}' is used before its definition at line {}", name, text_.tokens[i].line);
    }
    std::vector<std::string> names;
    for (const auto& [known_name, constant] : scope_.names.constants) names.push_back(known_name);
    if (scope_.parameters != nullptr) {
      for (const auto& [known_name, value] : *scope_.parameters) names.push_back(known_name);
    }
    semantic_error(
        where, "unknown name {}{}", in_quotes(name),
        names.empty() ? "; constants are defined before the word: let lean = 30" : did_you_mean(name, names));
  }

  static bool known(double a, double b) { return !std::isnan(a) && !std::isnan(b); }
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  const PlantTokens& text_;
  std::size_t& token_;
  std::size_t within_ = 0;  // characters of the token that are read
  int depth_ = 0;
  const Scope& scope_;
};

}  // namespace

bool is_number_function(std::string_view name) {
  for (const NumberFunction& function : number_functions) {
    if (function.name == name) return true;
  }
  return false;
}

double read_number(const PlantTokens& text, std::size_t& at, const Scope& scope, std::string_view what) {
  if (at >= text.tokens.size()) syntax_error(text.end, "the file ends where {} was expected", what);
  if (text.is(at, "(")) return ExpressionReader(text, at, scope).read();
  const auto value = parse_number(text.tokens[at].text);
  if (!value) {
    const bool name = is_identifier(text.tokens[at].text) &&
                      (scope.names.constants.contains(text.tokens[at].text) ||
                       (scope.parameters != nullptr && scope.parameters->contains(text.tokens[at].text)));
    syntax_error(text.where(at), "found {}, expected {} ({})", in_quotes(text.tokens[at].text), what,
                 name ? "names stand in parentheses" : "a finite number");
  }
  ++at;
  return *value;
}

}  // namespace bpms
