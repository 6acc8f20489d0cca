// Rules of an L-system: one a line; a line that begins with white space goes on from the one before.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/nearest.h"
#include "core/text.h"
#include "plant/exchange/lsystem_parts.h"

namespace bpms {

double LFormula::value(const double* parameters) const {
  std::vector<double> stack;
  for (const Step& step : steps) {
    if (step.what == '#' || step.what == '@') {
      stack.push_back(step.what == '#' ? step.number : parameters[step.parameter]);
      continue;
    }
    const double b = stack.back();
    if (step.what == '~') {
      stack.back() = -b;
      continue;
    }
    stack.pop_back();
    double& a = stack.back();
    switch (step.what) {
      case '+':
        a += b;
        break;
      case '-':
        a -= b;
        break;
      case '*':
        a *= b;
        break;
      case '/':
        a /= b;
        break;
      case '^':
        a = std::pow(a, b);
        break;
      case '<':
        a = a < b ? 1 : 0;
        break;
      case '>':
        a = a > b ? 1 : 0;
        break;
      case 'l':
        a = a <= b ? 1 : 0;
        break;
      case 'g':
        a = a >= b ? 1 : 0;
        break;
      case '=':
        a = a == b ? 1 : 0;
        break;
      case '!':
        a = a != b ? 1 : 0;
        break;
      case '&':
        a = a != 0 && b != 0 ? 1 : 0;
        break;
      default:
        a = a != 0 || b != 0 ? 1 : 0;
        break;
    }
  }
  return stack.back();
}

namespace {

// Operators from the loosest to the tightest; two-letter ones become one letter in a program.
class LFormulaReader {
 public:
  LFormulaReader(LText& text, const std::map<std::string, double>& constants,
                 const std::vector<std::string>& parameters)
      : text_(text), constants_(constants), parameters_(parameters) {}

  LFormula read() {
    either();
    return std::move(out_);
  }

 private:
  void push(char what) { out_.steps.push_back({what, 0, 0}); }
  bool take(char c) {
    if (text_.peek() != c) return false;
    text_.take();
    return true;
  }
  void either() {
    both();
    while (take('|')) take('|'), both(), push('|');
  }
  void both() {
    compare();
    while (take('&')) take('&'), compare(), push('&');
  }
  void compare() {
    sum();
    const char c = text_.peek();
    if (c != '<' && c != '>' && c != '=' && c != '!') return;
    const SourceLocation where = text_.here();
    text_.take();
    const bool equal = take('=');
    if (c == '!' && !equal) bad_input(where, "found '!', expected a comparison like !=");
    sum();
    push(c == '<' ? (equal ? 'l' : '<') : c == '>' ? (equal ? 'g' : '>') : c);
  }
  void sum() {
    product();
    // "->" belongs to the rule.
    for (char c = text_.peek(); (c == '+' || c == '-') && !text_.arrow(); c = text_.peek()) {
      text_.take();
      product();
      push(c);
    }
  }
  void product() {
    sign();
    for (char c = text_.peek(); c == '*' || c == '/'; c = text_.peek()) {
      text_.take();
      sign();
      push(c);
    }
  }
  void sign() {
    if (take('-')) {
      const Depth depth(*this);
      sign();
      push('~');
    } else {
      power();
    }
  }
  void power() {
    atom();
    if (take('^')) {
      const Depth depth(*this);
      sign();
      push('^');
    }
  }
  void atom() {
    const SourceLocation where = text_.here();
    if (take('(')) {
      const Depth depth(*this);
      either();
      if (!take(')'))
        bad_input(text_.here(), "expected ')' of the formula's bracket in line {}, column {}", where.line,
                  where.column);
      return;
    }
    if (is_lsystem_letter(text_.peek()) || text_.peek() == '_')
      return named(where, std::string(text_.name()));
    const auto value = parse_number(text_.number());
    if (!value) bad_input(where, "expected a number, a parameter or a constant");
    out_.steps.push_back({'#', *value, 0});
  }
  void named(const SourceLocation& where, const std::string& name) {
    const auto found = std::find(parameters_.begin(), parameters_.end(), name);
    if (found != parameters_.end()) {
      out_.steps.push_back({'@', 0, static_cast<std::uint32_t>(found - parameters_.begin())});
    } else if (const auto constant = constants_.find(name); constant != constants_.end()) {
      out_.steps.push_back({'#', constant->second, 0});
    } else {
      std::vector<std::string> known = parameters_;
      for (const auto& one : constants_) known.push_back(one.first);
      bad_input(where, "{} is neither a parameter here nor a constant{}", in_quotes(name),
                did_you_mean(name, known));
    }
  }

  struct Depth {
    explicit Depth(LFormulaReader& of) : reader(of) {
      constexpr int most = 200;
      if (++reader.depth_ > most) bad_input(reader.text_.here(), "a formula nested more than {} deep", most);
    }
    ~Depth() { --reader.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;
    LFormulaReader& reader;
  };

  LText& text_;
  const std::map<std::string, double>& constants_;
  const std::vector<std::string>& parameters_;
  LFormula out_;
  int depth_ = 0;
};

struct LLine {
  std::string text;  // with the lines that go on from it
  int number = 0;
};

class LSystemReader {
 public:
  LSystemReader(const std::string& path, std::string_view text) : path_(path), rest_(text) {
    out_.file = path;
  }

  LSystem read() {
    for (const LLine& line : lines()) read_line(line);
    if (out_.axiom.empty()) bad_input({path_}, "no axiom, expected a line `axiom A(1)`");
    if (out_.rules.empty()) bad_input({path_}, "no rules, expected lines `A(l) -> F(l) A(l*0.9)`");
    for (const Met& met : met_) check(met);
    return std::move(out_);
  }

 private:
  struct Met {  // a module as it stands in the text, to be checked when all rules are known
    char symbol;
    std::size_t count;
    SourceLocation where;
  };

  std::vector<LLine> lines() {
    std::vector<LLine> out;
    for (int number = 1; !rest_.empty(); ++number) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      const std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      const std::size_t first = line.find_first_not_of(" \t\r");
      if (first == std::string_view::npos || line[first] == '#') {
        if (!out.empty()) out.back().text += '\n';  // keeps the numbers of lines
      } else if (first > 0 && !out.empty()) {
        out.back().text += '\n' + std::string(line);
      } else {
        out.push_back({std::string(line), number});
      }
    }
    return out;
  }

  void read_line(const LLine& line) {
    if (read_lsetting(path_, line.text, line.number, out_.settings)) return;
    LText text(path_, line.text, line.number);
    LText look = text;
    const std::string word(look.name());
    if (word == "steps") return read_steps(look);
    if (word == "axiom") {
      out_.axiom = read_modules(look, {}, "the axiom");
      if (out_.axiom.empty()) bad_input(look.here(), "the axiom is empty");
      return;
    }
    if (!word.empty() && look.peek() == '=') return read_constant(look, word);
    read_rule(text);
  }

  void read_steps(LText& text) {
    out_.steps_where = text.here();
    constexpr long long most = 10'000;
    const auto value = parse_integer(text.number());
    if (!value || *value > most || !text.done())
      bad_input(out_.steps_where, "expected the number of steps (0 to {})", most);
    out_.steps = static_cast<int>(*value);
  }

  void read_constant(LText& text, const std::string& name) {
    text.take();
    const SourceLocation where = text.here();
    const double value = LFormulaReader(text, constants_, {}).read().value(nullptr);
    if (!text.done()) bad_input(text.here(), "expected the end of the line behind the constant {}", name);
    if (!std::isfinite(value)) bad_input(where, "the constant {} is not finite", name);
    if (!constants_.emplace(name, value).second) bad_input(where, "the constant {} is there already", name);
  }

  // A(l, w) : l > 1 -> ...
  void read_rule(LText& text) {
    LRule rule;
    rule.where = text.here();
    rule.symbol = text.take();
    std::vector<std::string> parameters;
    if (text.peek() == '(') {
      text.take();
      do {
        const SourceLocation where = text.here();
        const std::string name(text.name());
        if (name.empty()) bad_input(where, "expected the name of a parameter");
        if (std::find(parameters.begin(), parameters.end(), name) != parameters.end())
          bad_input(where, "the parameter {} is there already", name);
        parameters.push_back(name);
      } while (text.peek() == ',' && text.take() != 0);
      if (text.peek() != ')') bad_input(text.here(), "expected ',' or ')' behind a parameter");
      text.take();
    }
    if (!is_lsystem_letter(rule.symbol))
      bad_input(rule.where,
                "found {}, expected a setting, a constant `name = value`, an axiom or a rule `A(l) -> ...`",
                in_quotes(std::string(1, rule.symbol)));
    rule.parameters = parameters.size();
    if (text.peek() == ':') {
      text.take();
      rule.condition = LFormulaReader(text, constants_, parameters).read();
    }
    const SourceLocation arrow = text.here();
    if (text.take() != '-' || text.take() != '>')
      bad_input(arrow, "expected '->' of the rule for {}", in_quotes(std::string(1, rule.symbol)));
    for (const LRule& known : out_.rules)
      if (known.symbol == rule.symbol && known.parameters != rule.parameters)
        bad_input(rule.where, "'{}' with {} parameters, but with {} in the rule of line {}", rule.symbol,
                  rule.parameters, known.parameters, known.where.line);
    rule.successor = read_modules(text, parameters, "the rule");
    out_.rules.push_back(std::move(rule));
  }

  std::vector<LRule::Module> read_modules(LText& text, const std::vector<std::string>& parameters,
                                          const char* what) {
    std::vector<LRule::Module> out;
    LBrackets brackets;
    while (!text.done()) {
      const SourceLocation where = text.here();
      LRule::Module module;
      module.symbol = text.take();
      if (text.peek() == '(') {
        do {
          text.take();
          module.parameters.push_back(LFormulaReader(text, constants_, parameters).read());
        } while (text.peek() == ',');
        if (text.peek() != ')') bad_input(text.here(), "expected ',' or ')' behind a parameter");
        text.take();
      }
      constexpr std::size_t most = 16;
      if (module.parameters.size() > most) bad_input(where, "more than {} parameters", most);
      brackets.meet(module.symbol, where);
      met_.push_back({module.symbol, module.parameters.size(), where});
      out.push_back(std::move(module));
    }
    brackets.finish(what);
    return out;
  }

  void check(const Met& met) const {
    for (const LRule& rule : out_.rules) {
      if (rule.symbol != met.symbol) continue;
      if (rule.parameters != met.count)
        bad_input(met.where, "'{}' with {} parameters, but its rule in line {} has {}", met.symbol, met.count,
                  rule.where.line, rule.parameters);
      return;
    }
    const TurtleSymbol* known = turtle_symbol(met.symbol);
    if (known == nullptr)
      bad_input(met.where, "unknown symbol {}: no rule rewrites it and the turtle does not draw it",
                in_quotes(std::string(1, met.symbol)));
    if (met.count < known->least || met.count > known->most)
      bad_input(met.where, "'{}' with {} parameters, expected {}", met.symbol, met.count,
                known->most == 0 ? "none" : "none or one");
  }

  const std::string& path_;
  std::string_view rest_;
  std::map<std::string, double> constants_;
  std::vector<Met> met_;
  LSystem out_;
};

constexpr std::size_t most_derived_modules = 5'000'000;

void append_lmodules(const std::vector<LRule::Module>& modules, const double* parameters,
                     const SourceLocation& where, LString& out) {
  for (const LRule::Module& module : modules) {
    const auto first = static_cast<std::uint32_t>(out.parameters.size());
    out.modules.push_back({module.symbol, static_cast<std::uint8_t>(module.parameters.size()), first});
    for (const LFormula& formula : module.parameters) {
      const double value = formula.value(parameters);
      if (!std::isfinite(value)) bad_input(where, "a parameter of '{}' is not finite", module.symbol);
      out.parameters.push_back(value);
    }
  }
}

}  // namespace

LSystem parse_lsystem(const std::string& path, std::string_view text) {
  return LSystemReader(path, text).read();
}

LSystem read_lsystem(const std::string& path) {
  return parse_lsystem(path, read_text(path));
}

LString derive(const LSystem& system, std::optional<int> steps) {
  LString out;
  out.file = system.file;
  out.settings = system.settings;
  append_lmodules(system.axiom, nullptr, {system.file}, out);
  std::array<std::vector<const LRule*>, 256> rules;
  for (const LRule& rule : system.rules) rules[static_cast<unsigned char>(rule.symbol)].push_back(&rule);
  const int count = steps.value_or(system.steps);
  for (int step = 1; step <= count; ++step) {
    LString next;
    for (const LModule& module : out.modules) {
      const double* parameters = out.parameters.data() + module.first;
      const LRule* found = nullptr;
      for (const LRule* rule : rules[static_cast<unsigned char>(module.symbol)]) {
        if (rule->condition && rule->condition->value(parameters) == 0) continue;
        found = rule;
        break;
      }
      if (found != nullptr) {
        append_lmodules(found->successor, parameters, found->where, next);
      } else {
        next.modules.push_back(
            {module.symbol, module.count, static_cast<std::uint32_t>(next.parameters.size())});
        next.parameters.insert(next.parameters.end(), parameters, parameters + module.count);
      }
      if (next.modules.size() > most_derived_modules || next.parameters.size() > 4 * most_derived_modules)
        bad_input(system.steps_where.line > 0 ? system.steps_where : SourceLocation{system.file},
                  "more than {} modules in step {} of {}", most_derived_modules, step, count);
    }
    out.modules = std::move(next.modules);
    out.parameters = std::move(next.parameters);
  }
  return out;
}

}  // namespace bpms
