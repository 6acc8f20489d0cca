// What stands before the word: units, include, let, organ.
#include <algorithm>
#include <filesystem>

#include "core/nearest.h"
#include "plant/language/attributes.h"
#include "plant/language/parse.h"

namespace bpms {
namespace {

const std::vector<std::string> length_units{"cm", "mm", "m"};

class StatementReader {
 public:
  StatementReader(const PlantReadOptions& options, PlantStatements& out) : options_(options), out_(out) {}

  std::size_t read(const PlantTokens& text, bool library) {
    std::string unit = "cm";
    std::size_t at = text.is(0, "units") ? read_unit(text, unit) : 0;
    if (files_.empty()) out_.unit = unit;
    files_.push_back(text.file);
    while (at < text.tokens.size()) {
      const std::string_view word = text.tokens[at].text;
      if (word == "units") syntax_error(text.where(at), "'units' stands first in its file");
      if (word == "let") {
        read_constant(text, at);
      } else if (word == "organ") {
        read_organ(text, at, unit);
      } else if (word == "include") {
        read_include(text, at);
      } else if (library) {
        read_block(text, at, unit);
      } else {
        break;
      }
    }
    files_.pop_back();
    return at;
  }

 private:
  static std::size_t read_unit(const PlantTokens& text, std::string& unit) {
    if (text.tokens.size() < 2)
      syntax_error(text.end, "the file ends where a unit was expected: units cm, mm or m");
    unit = text.tokens[1].text;
    if (std::ranges::find(length_units, unit) == length_units.end())
      syntax_error(text.where(1), "unknown unit {}{}", in_quotes(unit), did_you_mean(unit, length_units));
    return 2;
  }

  static std::string read_name(const PlantTokens& text, std::size_t& at, std::string_view of_what) {
    if (at >= text.tokens.size()) syntax_error(text.end, "the file ends where {} was expected", of_what);
    const std::string_view name = text.tokens[at].text;
    if (!is_identifier(name))
      syntax_error(text.where(at), "found {}, expected {} (a letter, then letters, digits, _)",
                   in_quotes(name), of_what);
    require_free_name(name, of_what, text.where(at));
    ++at;
    return std::string(name);
  }

  static void expect(const PlantTokens& text, std::size_t& at, std::string_view what,
                     std::string_view after) {
    if (at >= text.tokens.size())
      syntax_error(text.end, "the file ends where '{}' was expected {}", what, after);
    if (text.tokens[at].text != what)
      syntax_error(text.where(at), "found {}, expected '{}' {}", in_quotes(text.tokens[at].text), what,
                   after);
    ++at;
  }

  void read_constant(const PlantTokens& text, std::size_t& at) {
    const SourceLocation where = text.where(++at);
    const std::string name = read_name(text, at, "the name of a constant");
    if (const auto other = out_.names.constants.find(name); other != out_.names.constants.end())
      semantic_error(where, "a second '{}'; the first is at {}", name, other->second.where.str());
    expect(text, at, "=", "after the constant's name: let lean = 30");
    const double value = read_number(text, at, {out_.names}, fmt::format("the value of {}", name));
    out_.names.constants[name] = {value, where, out_.names.defined++};
  }

  void read_organ(const PlantTokens& text, std::size_t& at, const std::string& unit) {
    const SourceLocation where = text.where(++at);
    const std::string name = read_name(text, at, "the name of an organ");
    if (const auto other = out_.names.organs.find(name); other != out_.names.organs.end())
      semantic_error(where, "a second organ '{}'; the first is at {}", name, other->second.where.str());
    OrganDefinition organ;
    organ.where = where;
    organ.unit = unit;
    organ.included = files_.size() > 1;
    if (text.is(at, "(")) read_parameters(text, at, organ);
    organ.body = read_body(text, at);
    organ.order = out_.names.defined++;
    out_.names.organs[name] = std::move(organ);
  }

  // Tokens from `at`, an opening one, to the closing one that belongs to it; without the two.
  static PlantTokens enclosed(const PlantTokens& text, std::size_t& at, std::string_view open,
                              std::string_view close, std::string_view what) {
    const SourceLocation opened = text.where(at);
    PlantTokens out{text.file, {}, {}};
    int depth = 0;
    for (; at < text.tokens.size(); ++at) {
      const Token& token = text.tokens[at];
      if (token.text == open) ++depth;
      if (token.text == close && --depth == 0) {
        out.end = text.where(at++);
        out.tokens.erase(out.tokens.begin());
        return out;
      }
      if (open == "(" && (token.text == "{" || token.text == "}")) break;
      out.tokens.push_back(token);
    }
    syntax_error(opened, "{} opened here is never closed, expected '{}'", what, close);
  }

  void read_parameters(const PlantTokens& text, std::size_t& at, OrganDefinition& organ) {
    PlantTokens list = enclosed(text, at, "(", ")", "list of parameters");
    separate_commas(list);
    for (std::size_t i = 0; i < list.tokens.size();) {
      const SourceLocation where = list.where(i);
      OrganDefinition::Parameter parameter;
      parameter.name = read_name(list, i, "the name of a parameter");
      for (const OrganDefinition::Parameter& other : organ.parameters) {
        if (other.name == parameter.name) semantic_error(where, "a second parameter '{}'", parameter.name);
      }
      if (list.is(i, "="))
        parameter.value =
            read_number(list, ++i, {out_.names}, fmt::format("the usual value of {}", parameter.name));
      organ.parameters.push_back(std::move(parameter));
      if (i == list.tokens.size()) break;
      expect(list, i, ",", "between parameters, or '=' and a value");
      if (i == list.tokens.size()) syntax_error(list.end, "found ')', expected another parameter");
    }
  }

  static void separate_commas(PlantTokens& list) {
    std::vector<Token> out;
    for (const Token& token : list.tokens) {
      std::size_t begin = 0;
      const auto piece = [&](std::size_t from, std::size_t to) {
        if (to > from)
          out.push_back(
              {token.text.substr(from, to - from), token.line, token.column + static_cast<int>(from)});
      };
      for (std::size_t k = 0; k < token.text.size(); ++k) {
        if (token.text[k] != ',') continue;
        piece(begin, k);
        piece(k, k + 1);
        begin = k + 1;
      }
      piece(begin, token.text.size());
    }
    list.tokens = std::move(out);
  }

  static PlantTokens read_body(const PlantTokens& text, std::size_t& at) {
    std::size_t brace = at;
    expect(text, brace, "{", "before the organ's word: organ NAME(len, pairs = 3) { ... }");
    return enclosed(text, at, "{", "}", "organ");
  }

  void read_include(const PlantTokens& text, std::size_t& at) {
    const SourceLocation where = text.where(++at);
    if (at >= text.tokens.size() || text.tokens[at].text.front() != '"')
      syntax_error(where, "expected a file's name in quotes: include \"organs.bpms\"");
    const std::string name = unquoted(text.tokens[at++].text);
    if (name.empty()) syntax_error(where, "an empty file name");
    const auto beside = std::filesystem::path(text.file).parent_path() / name;
    const std::string path = beside.lexically_normal().string();
    const auto is_path = [&](const std::string& file) {
      return std::filesystem::path(file).lexically_normal().string() == path;
    };
    if (const auto open = std::ranges::find_if(files_, is_path); open != files_.end()) {
      std::string chain;
      for (auto file = open; file != files_.end(); ++file) chain += *file + " -> ";
      semantic_error(where, "files include each other: {}{}", chain, path);
    }
    constexpr std::size_t deepest = 32;
    if (files_.size() > deepest) semantic_error(where, "more than {} files within each other", deepest);
    if (std::ranges::any_of(out_.inputs, is_path)) return;  // two libraries may need one third
    std::string content;
    try {
      content = options_.include ? options_.include(path) : read_text(path);
    } catch (const Error& error) {
      throw Error(error.kind(), where, fmt::format("included file {}: {}", in_quotes(path), error.message()));
    }
    out_.inputs.push_back(path);
    out_.texts.push_back(std::move(content));
    read(plant_tokens(path, out_.texts.back()), true);
  }

  void read_block(const PlantTokens& text, std::size_t& at, const std::string& unit) {
    if (!begins_block(text, at))
      syntax_error(text.where(at),
                   "found {}, expected let, organ, include or a block; a file that is included holds no word",
                   in_quotes(text.tokens[at].text));
    ParsedBlock block = parse_block(text, at, unit, {out_.names});
    block.included = true;
    add_block(out_.blocks, std::move(block));
  }

  const PlantReadOptions& options_;
  PlantStatements& out_;
  std::vector<std::string> files_;  // being read, the outermost first
};

}  // namespace

bool is_statement(std::string_view word) {
  return word == "units" || word == "include" || word == "let" || word == "organ";
}

void require_free_name(std::string_view name, std::string_view of_what, const SourceLocation& where) {
  if (is_attribute_name(name))
    semantic_error(where, "{} is an attribute, it cannot be {}", in_quotes(name), of_what);
  if (is_number_function(name) || is_statement(name))
    semantic_error(where, "{} is a word of the language, it cannot be {}", in_quotes(name), of_what);
}

std::size_t read_statements(const PlantTokens& text, bool library, const PlantReadOptions& options,
                            PlantStatements& out) {
  out.inputs.push_back(text.file);
  return StatementReader(options, out).read(text, library);
}

}  // namespace bpms
